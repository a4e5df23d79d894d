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

/** `raw` with the arguments that may be left out, and with errors thrown. */
export function throwing(raw) {
  const count = raw.argCount;
  return function (...args) {
    args.length = count;
    let answer;
    try {
      answer = raw.apply(this, args);
    } catch (error) {
      // A disposed object, or one of another class.
      throw error?.name === 'BindingError' ? misused(error) : error;
    }
    if (answer instanceof Failure) throw new DymsumError(answer.data);
    return answer;
  };
}
