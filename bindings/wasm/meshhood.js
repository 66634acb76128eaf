// SPDX-License-Identifier: MIT
// The public part of the package. meshhood.d.ts documents it.
export { Curvature } from './curvature.js';
export { MeshhoodError, initialize } from './instance.js';
export { readMesh } from './mesh_file.js';
export { MeshIndex } from './mesh_index.js';
export { version } from './version.js';
export { weld } from './weld.js';
