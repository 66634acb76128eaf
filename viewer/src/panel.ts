// SPDX-License-Identifier: MIT
// The controls: the values that they show, and the changes that they request.
import { EXAMPLES } from './examples';
import { shortNumber } from './numbers';
import { mapOf } from './paint';
import type { Range, Scalar } from './scalar';
import type { Cut, Look } from './view';

export interface Wishes {
  open(file: File): void;
  example(name: string): void;
  vertex(vertex: number): void;
  /** `isFinal` once the slider is released. */
  radius(radius: number, unit: 'mesh' | 'edge', isFinal: boolean): void;
  color(choice: string): void;
  look(look: Look): void;
  random(): void;
  focus(): void;
  savePicture(): void;
  saveIds(): void;
  saveIndex(): void;
  copyLink(): void;
}

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

// The slider is logarithmic, and its left end is 0.
const SLIDER = 1000;
const LEAST_EDGES = 0.5;

export class Panel {
  readonly #wishes: Wishes;
  #meanEdge = 1;
  #mostEdges = 100;

  constructor(wishes: Wishes) {
    this.#wishes = wishes;
    this.#connectFiles();
    this.#connectQuery();
    this.#connectDisplay();
    for (const [id, wish] of Object.entries({
      random: wishes.random, focus: wishes.focus, 'save-picture': wishes.savePicture, 'save-ids': wishes.saveIds,
      'save-index': wishes.saveIndex, 'copy-link': wishes.copyLink,
    })) {
      find(id).addEventListener('click', () => wish());
    }
    find('help').addEventListener('click', () => find<HTMLDialogElement>('keys').showModal());
    find('fold').addEventListener('click', () => this.#fold());
    if (matchMedia('(max-width: 700px)').matches) this.#fold();
  }

  #fold(): void {
    const folded = find('panel').classList.toggle('folded');
    find('fold').setAttribute('aria-expanded', String(!folded));
  }

  #connectFiles(): void {
    const file = find<HTMLInputElement>('file');
    find('open').addEventListener('click', () => file.click());
    file.addEventListener('change', () => {
      if (file.files?.[0]) this.#wishes.open(file.files[0]);
      file.value = '';
    });
    const examples = find<HTMLSelectElement>('example');
    for (const { name, title, trap } of EXAMPLES) {
      const option = new Option(title, name);
      option.title = trap;
      examples.add(option);
    }
    examples.addEventListener('change', () => {
      if (examples.value !== '') this.#wishes.example(examples.value);
    });
  }

  #connectQuery(): void {
    const slider = find<HTMLInputElement>('radius');
    slider.addEventListener('input', () => this.#wishes.radius(this.#fromSlider(Number(slider.value)), 'edge', false));
    slider.addEventListener('change', () => this.#wishes.radius(this.#fromSlider(Number(slider.value)), 'edge', true));
    for (const [id, unit] of [['radius-edges', 'edge'], ['radius-units', 'mesh']] as const) {
      const input = find<HTMLInputElement>(id);
      input.addEventListener('change', () => {
        if (input.reportValidity()) this.#wishes.radius(Number(input.value), unit, true);
      });
    }
    const vertex = find<HTMLInputElement>('vertex');
    vertex.addEventListener('change', () => {
      if (vertex.value === '') vertex.reportValidity(); else this.#wishes.vertex(Number(vertex.value));
    });
  }

  #connectDisplay(): void {
    const color = find<HTMLSelectElement>('color');
    color.addEventListener('change', () => this.#wishes.color(color.value));
    for (const id of ['cut', 'nearer', 'wireframe', 'ball']) {
      find(id).addEventListener('change', () => this.#wishes.look(this.look));
    }
  }

  get look(): Look {
    const [nearer, wireframe, ball] = ['nearer', 'wireframe', 'ball'].map((id) => find<HTMLInputElement>(id).checked);
    return { cut: find<HTMLSelectElement>('cut').value as Cut, hideNearer: nearer, wireframe, ball };
  }

  set look(look: Look) {
    find<HTMLSelectElement>('cut').value = look.cut;
    find<HTMLInputElement>('nearer').checked = look.hideNearer;
    find<HTMLInputElement>('wireframe').checked = look.wireframe;
    find<HTMLInputElement>('ball').checked = look.ball;
  }

  setMesh(name: string, facts: string, vertices: number, faces: number, meanEdge: number, mostEdges: number): void {
    find('name').textContent = name;
    find('name').title = name;
    find('facts').textContent = facts;
    this.#meanEdge = meanEdge;
    this.#mostEdges = Math.max(mostEdges, 2 * LEAST_EDGES);
    find<HTMLInputElement>('vertex').max = String(Math.max(vertices - 1, 0));
    for (const option of document.querySelectorAll<HTMLOptionElement>('[data-needs=faces]')) option.disabled = faces === 0;
  }

  setExample(name: string | null): void {
    find<HTMLSelectElement>('example').value = name ?? '';
  }

  /** The choices of colors that this mesh adds, by their values. */
  set ownColors(titles: Map<string, string>) {
    const group = find<HTMLOptGroupElement>('own-colors');
    group.replaceChildren(...[...titles].map(([value, title]) => new Option(title, value)));
    group.hidden = titles.size === 0;
  }

  hasColor(value: string): boolean {
    return [...find<HTMLSelectElement>('color').options].some((option) => option.value === value && !option.disabled);
  }

  set color(value: string) {
    find<HTMLSelectElement>('color').value = value;
  }

  setVertex(vertex: number): void {
    find<HTMLInputElement>('vertex').value = vertex < 0 ? '' : String(vertex); // none yet
  }

  /** In the unit of the mesh. */
  setRadius(radius: number): void {
    const edges = radius / (this.#meanEdge || 1);
    find<HTMLInputElement>('radius').value = String(this.#toSlider(edges));
    find<HTMLInputElement>('radius-edges').value = shortNumber(edges);
    find<HTMLInputElement>('radius-units').value = shortNumber(radius);
  }

  #fromSlider(place: number): number {
    if (place <= 0) return 0;
    return LEAST_EDGES * (this.#mostEdges / LEAST_EDGES) ** (place / SLIDER);
  }

  #toSlider(edges: number): number {
    if (edges < LEAST_EDGES) return 0;
    return Math.round((SLIDER * Math.log(edges / LEAST_EDGES)) / Math.log(this.#mostEdges / LEAST_EDGES));
  }

  setLegend(scalar: Scalar | null, range: Range | null): void {
    const legend = find('legend');
    legend.hidden = scalar === null || range === null;
    if (scalar === null || range === null) return;
    legend.querySelector<HTMLElement>('.ramp')!.style.background = mapOf(range).gradient;
    [shortNumber(range[0]), scalar.title, shortNumber(range[1])].forEach((text, i) => {
      legend.querySelectorAll('span')[i].textContent = text;
    });
  }

  /** Below the legend: the value at the vertex. */
  setValue(value: number): void {
    find('legend').querySelector('p')!.textContent =
      `at the vertex: ${Number.isFinite(value) ? shortNumber(value) : 'no value'}`;
  }

  openDisplay(): void {
    find<HTMLDetailsElement>('display').open = true;
  }
}
