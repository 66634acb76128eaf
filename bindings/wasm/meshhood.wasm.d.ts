// SPDX-License-Identifier: MIT
/** The module for `initialize`, as bundlers hand it over: its address or its bytes. */
declare const source: string | Uint8Array;
export default source;
