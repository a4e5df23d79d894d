// What is thrown.

/** What a bound function returns instead of an answer: see web/wasm/bind.h. */
export class Failure {
  constructor(data) {
    this.data = data;
  }
}

export class DymsumError extends Error {
  constructor({ code, reason, message, evidence }) {
    super(message);
    this.name = 'DymsumError';
    this.code = code;
    this.reason = reason;
    this.evidence = evidence;
  }

  toData() {
    const { code, reason, message, evidence } = this;
    return { code, reason, message, evidence };
  }
}

function misused(error) {
  const { message } = error;
  return new DymsumError({ code: 'invalid_argument', reason: message, message, evidence: {} });
}

/** What no memory of the module's kind holds is told before it is copied there. */
const mostBytes = 2 ** 30;

function tooLarge() {
  const reason = 'an input of a gigabyte and more does not fit into the memory of WebAssembly';
  return new DymsumError({ code: 'out_of_memory', reason, message: reason, evidence: {} });
}

/** An argument as the module takes it: buffers of another realm (a frame, a test's sandbox) are known by their names alone. */
function taken(argument) {
  if (typeof argument === 'string' && argument.length >= mostBytes) throw tooLarge();
  if (typeof argument !== 'object' || argument === null) return argument;
  if (argument.byteLength >= mostBytes) throw tooLarge();
  if (argument instanceof ArrayBuffer || argument instanceof Uint8Array) return argument;
  const tag = Object.prototype.toString.call(argument);
  return tag === '[object ArrayBuffer]' || tag === '[object Uint8Array]' ? new Uint8Array(argument) : argument;
}

let running = 0;
const afterwards = [];

/** Calls `action` now, or where the module is at work, in a progress function say, once it has ended: what it uses stays. */
export function whenIdle(action) {
  if (running > 0) afterwards.push(action);
  else action();
}

function call(object, raw, args) {
  ++running;
  try {
    return raw.apply(object, args);
  } catch (error) {
    // A disposed object, or one of another class.
    throw error?.name === 'BindingError' ? misused(error) : error;
  } finally {
    if (--running === 0) for (const action of afterwards.splice(0)) action();
  }
}

/** `raw` with the arguments that may be left out, and with errors thrown. */
export function throwing(raw) {
  const count = raw.argCount;
  return function (...args) {
    args.length = count;
    const answer = call(this, raw, args.map(taken));
    if (answer instanceof Failure) throw new DymsumError(answer.data);
    return answer;
  };
}

/** A property's getter, likewise. */
export function throwingGetter(raw) {
  return function () {
    return call(this, raw, []);
  };
}
