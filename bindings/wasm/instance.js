// SPDX-License-Identifier: MIT
// One instance of the WebAssembly module: its memory, its calls and its errors. Each mesh has an instance of its own,
// because the memory of an instance never shrinks: it is given back as a whole.

import { version } from './version.js';

/** Names of the error codes, in the order of the enumeration `ErrorCode` in C++. */
const CODES = [
  'VertexOutOfRange', 'InvalidRadius', 'InvalidOption', 'InvalidMesh', 'MalformedFile', 'UnsupportedFormat',
  'MalformedIndex', 'IoFailure', 'TooLarge', 'Cancelled',
];

/** Memory grows by pages. */
const PAGE_BYTES = 2 ** 16;

/** What an instance can hold is less than the 4 GiB that it can address. */
const MOST_BYTES = 2 ** 32 - PAGE_BYTES;

/** Errors of arguments, after which the instance is unchanged. Where memory is out, the module traps without one. */
const ARGUMENT_ERRORS = new Set(['VertexOutOfRange', 'InvalidRadius', 'InvalidOption', 'InvalidMesh', 'TooLarge']);

export class MeshhoodError extends Error {
  constructor(code, message, options) {
    super(message, options);
    this.name = 'MeshhoodError';
    this.code = code;
  }
}

// Not a literal, or bundlers for browsers would look for it.
const NODE_FILES = 'node:fs/promises';

/** The compiled module; a promise while it is being compiled. */
let compiled = null;

/** The module has an export with this name and its version. */
const MARK = 'meshhood ';

/** `name` of a source is its address, for messages. */
function checkModule(module, name) {
  const marks = WebAssembly.Module.exports(module).map((part) => part.name).filter((part) => part.startsWith(MARK));
  if (marks.includes(MARK + version)) return module;
  throw new Error(`${name}: ${marks[0] ?? 'another module'}, expected the module of ${MARK}${version}`);
}

async function compileBytes(bytes, name) {
  try {
    return checkModule(await WebAssembly.compile(bytes), name);
  } catch (error) {
    if (!(error instanceof WebAssembly.CompileError)) throw error;
    throw new WebAssembly.CompileError(`${name}: ${error.message}`, { cause: error });
  }
}

async function bytesOf(response, name) {
  if (!response.ok) throw new Error(`${name}: ${response.status} ${response.statusText}`);
  return response.arrayBuffer();
}

/** `address` is absolute, or relative to the page. Node reads files, which its `fetch` does not. */
async function download(address) {
  if (address.startsWith('file:') && typeof process !== 'undefined') {
    const files = await import(/* @vite-ignore */ /* webpackIgnore: true */ NODE_FILES);
    return files.readFile(new URL(address));
  }
  const response = await fetch(address).catch((error) => {
    throw new TypeError(`${address}: ${error.message}`, { cause: error });
  });
  return bytesOf(response, address);
}

async function compile(source) {
  const given = await source;
  if (given instanceof WebAssembly.Module) return checkModule(given, 'source');
  if (given instanceof ArrayBuffer || ArrayBuffer.isView(given)) return compileBytes(given, 'source');
  if (typeof Response !== 'undefined' && given instanceof Response) {
    const name = given.url || 'source';
    return compileBytes(await bytesOf(given, name), name);
  }
  if (typeof given === 'string' || given instanceof URL) {
    const address = String(given);
    return compileBytes(await download(address), address);
  }
  throw new TypeError(`source: ${String(given)}, expected an address, a Response, bytes or a WebAssembly.Module`);
}

export async function initialize(source = new URL('./meshhood.wasm', import.meta.url)) {
  if (compiled instanceof WebAssembly.Module) return;
  compiled ??= compile(source);
  try {
    compiled = await compiled;
  } catch (error) {
    compiled = null;
    throw error;
  }
}

const NO_ENTRY = 76; // ENOTCAPABLE of WASI

/** What the C library of WASI imports. It has no files, and an empty environment. */
function wasi(memory) {
  return {
    environ_sizes_get(count, size) {
      new Uint32Array(memory().buffer, count, 1)[0] = 0;
      new Uint32Array(memory().buffer, size, 1)[0] = 0;
      return 0;
    },
    environ_get: () => 0,
    clock_time_get(_clock, _precision, time) {
      new BigUint64Array(memory().buffer, time, 1)[0] = BigInt(Math.round(performance.now() * 1e6));
      return 0;
    },
    proc_exit() {
      throw new WebAssembly.RuntimeError('exit');
    },
  };
}

const outOfMemory = (cause) => new MeshhoodError('TooLarge', 'not enough memory', { cause });

/** The result of `allocate`, which throws a RangeError where memory is out. */
function withMemory(allocate) {
  try {
    return allocate();
  } catch (error) {
    throw error instanceof RangeError ? outOfMemory(error) : error;
  }
}

/** Whether `error` is the end of an instance, and not the exception of a callback. */
function isTrap(error) {
  return error instanceof WebAssembly.RuntimeError || error instanceof RangeError;
}

export class Instance {
  #exports;
  #error = null; // what the module reported before it trapped
  #exception = null; // { thrown }: what a callback threw, which may be null, too
  #progress = null;

  constructor() {
    if (!(compiled instanceof WebAssembly.Module)) {
      throw new Error('meshhood: call initialize() first, and await it');
    }
    const handlers = wasi(() => this.#exports.memory);
    const imports = { meshhood: this.#host() };
    for (const { module, name } of WebAssembly.Module.imports(compiled)) {
      imports[module] ??= {};
      imports[module][name] ??= handlers[name] ?? (() => NO_ENTRY);
    }
    this.#exports = withMemory(() => new WebAssembly.Instance(compiled, imports)).exports;
    this.#exports._initialize();
    this.#exports.start();
  }

  #host() {
    return {
      keep_error: (code, message, size) => {
        const text = new TextDecoder().decode(this.view(Uint8Array, message, size));
        this.#error = new MeshhoodError(CODES[code], text);
      },
      report_progress: (done, total) => {
        try {
          return this.#progress(done, total) === false ? 0 : 1;
        } catch (thrown) {
          this.#exception = { thrown };
          return 0;
        }
      },
    };
  }

  /** A copy of this instance: of its memory, which holds all state between calls. */
  clone() {
    if (this.#exports === null) throw new Error('meshhood: this object has been disposed');
    const copy = new Instance();
    const [from, to] = [this.#exports.memory, copy.#exports.memory];
    withMemory(() => to.grow((from.buffer.byteLength - to.buffer.byteLength) / PAGE_BYTES));
    new Uint8Array(to.buffer).set(new Uint8Array(from.buffer));
    return copy;
  }

  /** Drops the module and its memory. */
  dispose() {
    this.#exports = null;
  }

  get memoryBytes() {
    return this.#exports === null ? 0 : this.#exports.memory.buffer.byteLength;
  }

  /** Calls the function `name` of the module. An error that leaves the instance in an unknown state disposes it. */
  call(name, ...values) {
    if (this.#exports === null) throw new Error('meshhood: this object has been disposed');
    const stack = this.#exports.__stack_pointer;
    const top = stack.value;
    try {
      return this.#exports[name](...values);
    } catch (trap) {
      stack.value = top;
      throw this.#translate(trap);
    }
  }

  #translate(trap) {
    const [error, exception] = [this.#error, this.#exception];
    this.#error = null;
    this.#exception = null;
    if (error === null && !isTrap(trap)) return trap; // of a value that is no number, before the module was entered
    if (!ARGUMENT_ERRORS.has(error?.code)) this.dispose();
    if (exception !== null) return exception.thrown;
    return error ?? outOfMemory(trap);
  }

  /** As `call`; `progress` is called during it. */
  callWithProgress(progress, name, ...values) {
    this.#progress = progress;
    try {
      return this.call(name, ...values);
    } finally {
      this.#progress = null;
    }
  }

  /** Copies arrays into the memory of the module, and calls `use` with their addresses, 0 for null. */
  with(arrays, use) {
    const addresses = [];
    try {
      for (const array of arrays) addresses.push(array === null ? 0 : this.#place(array));
      return use(...addresses);
    } finally {
      for (const address of addresses) this.#exports?.release(address);
    }
  }

  /** Copies a typed array. Returns the address. */
  #place(array) {
    const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
    if (bytes.byteLength > MOST_BYTES) {
      throw new MeshhoodError('TooLarge', `${bytes.byteLength} bytes, but WebAssembly addresses 4 GiB`);
    }
    const address = this.call('allocate', bytes.byteLength) >>> 0;
    new Uint8Array(this.#exports.memory.buffer, address, bytes.byteLength).set(bytes);
    return address;
  }

  /** A view of `count` numbers in the memory of the module, valid until the next call. */
  view(Type, address, count) {
    return new Type(this.#exports.memory.buffer, address >>> 0, count >>> 0);
  }

  /** A copy. */
  take(Type, address, count) {
    return withMemory(() => this.view(Type, address, count).slice());
  }

  /** A copy of the array `name`, whose functions in the module return its address and its size. */
  takeArray(Type, name) {
    return this.take(Type, this.call(name), this.call(`${name}_size`));
  }

  takeIds() {
    return this.takeArray(Uint32Array, 'answer_ids');
  }

  takeReals() {
    return this.takeArray(Float64Array, 'answer_reals');
  }

  takeCounts() {
    return this.takeArray(Uint32Array, 'answer_counts');
  }

  /** All of an answer that may be large, whose memory the module gives back. */
  takeAnswer() {
    const answer = { ids: this.takeIds(), reals: this.takeReals(), counts: this.takeCounts() };
    this.call('release_answer');
    return answer;
  }
}

/** An instance that `fill` has filled: a new one, or the one that is given. It is disposed if that fails. */
export function makeInstance(fill, instance = new Instance()) {
  try {
    fill(instance);
  } catch (error) {
    instance.dispose();
    throw error;
  }
  return instance;
}

/** An object of the package that owns an instance, and with it all its memory, which is collected with it. */
export class Owner {
  constructor(instance) {
    Object.defineProperty(this, 'instance', { value: instance }); // for the classes of the package only
  }

  get memoryBytes() {
    return this.instance.memoryBytes;
  }

  dispose() {
    this.instance.dispose();
  }
}

// Compilers of `using` take this symbol where there is no other.
Owner.prototype[Symbol.dispose ?? Symbol.for('Symbol.dispose')] = Owner.prototype.dispose;
