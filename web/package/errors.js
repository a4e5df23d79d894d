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

/** An argument that no function takes. */
export function refusal(reason, code = 'invalid_argument', cause = undefined) {
  const error = new DymsumError({ code, reason, message: reason, evidence: {} });
  if (cause !== undefined) error.cause = cause;
  return error;
}
