// SPDX-License-Identifier: MIT
// The name of the search button is what it shows, its keys included: the label of the theme leaves them out.
for (const button of document.querySelectorAll('.navbar-persistent--container .search-button-field')) {
  button.removeAttribute('aria-label');
}

// Loads the viewer on the start page when its button is pressed, because it has several megabytes.
for (const place of document.querySelectorAll('#live')) {
  place.querySelector('button').addEventListener('click', () => {
    const frame = document.createElement('iframe');
    frame.src = place.dataset.page;
    frame.title = 'The viewer: a folded surface and the neighborhood of a vertex';
    frame.allow = 'fullscreen; clipboard-write';
    place.replaceChildren(frame);
    frame.focus();
  });
}
