// Functions of the module as the package has them: options checked, and errors thrown.
import { checkOptions, optionsOf, taken } from './arguments.js';
import { DymsumError, Failure, refusal } from './errors.js';

/** What the engine throws where an argument is of another kind: a disposed object, one of another class, a text for a number. */
const kindErrors = new Set(['BindingError', 'TypeError', 'RangeError']);

let running = 0;
const afterwards = [];

/** Calls `action` now, or where the module is at work, in a progress function say, once it has ended: what it uses stays. */
export function whenIdle(action) {
  if (running > 0) afterwards.push(action);
  else action();
}

function call(object, name, raw, args) {
  const watch = {};
  const given = args.map((argument) => taken(argument, watch));
  ++running;
  try {
    return raw.apply(object, given);
  } catch (error) {
    // What a function of the caller threw is the caller's.
    if (watch.thrown?.error === error || !kindErrors.has(error?.name)) throw error;
    throw refusal(`${name}: ${error.message}`, 'invalid_argument', error);
  } finally {
    if (--running === 0) for (const action of afterwards.splice(0)) action();
  }
}

/** `raw` with the arguments that may be left out, and with errors thrown. */
export function throwing(raw, name) {
  const count = raw.argCount;
  const [place, known] = optionsOf[name] ?? [-1, []];
  return function (...args) {
    args.length = count;
    if (place >= 0) checkOptions(name, args[place], known);
    const answer = call(this, name, raw, args);
    if (answer instanceof Failure) throw new DymsumError(answer.data);
    return answer;
  };
}

/** A property's getter, likewise. */
export function throwingGetter(raw, name) {
  return function () {
    return call(this, name, raw, []);
  };
}
