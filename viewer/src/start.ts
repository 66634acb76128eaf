// SPDX-License-Identifier: MIT
// What the page shows of a mesh first: what the link says; else what was written into the page with the mesh; else the
// query of the example.
import type { FirstQuery } from './examples';
import type { Opened } from './messages';
import type { Asked } from './opening';
import type { Look } from './view';

export interface Start {
  vertex: number;
  /** In the unit of the mesh. */
  radius: number;
  /** Methods that are not shown. */
  hidden: string[];
  /** An answer that was written into the page. */
  ids: Uint32Array | null;
  look: Look;
  /** Null: the camera looks at the query, if there is a reason to look there, or else at the whole mesh. */
  camera: number[] | null;
  looksAtQuery: boolean;
  /** From where it looks at the query; by default along the normal. */
  from: FirstQuery['from'];
}

/** `query` is that of the example, or one for a mesh without. */
export function startOf(opened: Opened, { source, link, pageData }: Asked, query: FirstQuery): Start {
  const settings = pageData?.settings ?? null;
  const isLink = link.vertex !== null;
  const isPassed = settings?.vertex !== undefined;
  const vertex = link.vertex ?? settings?.vertex ?? Math.floor(query.at * opened.vertices);
  const meanEdge = opened.meanEdge || 1;
  const passed = (settings?.radius ?? NaN) * (settings?.unit === 'edge' ? meanEdge : 1);
  const linked = (link.radius ?? NaN) * meanEdge;
  const look = { ...link.look };
  if (!isLink) look.cut = query.cut ?? look.cut;
  return {
    vertex: Math.min(vertex, opened.vertices - 1),
    radius: [linked, passed].find(Number.isFinite) ?? query.radius * meanEdge,
    hidden: link.hidden,
    ids: settings?.ids === undefined ? null : Uint32Array.from(settings.ids),
    look,
    camera: link.camera,
    looksAtQuery: isLink || isPassed || source.kind === 'example',
    from: isLink ? undefined : query.from,
  };
}
