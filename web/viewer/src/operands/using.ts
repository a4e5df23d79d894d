// An object of the module for as long as it is looked at.

/** Disposes of the object whatever comes; `visit` must not keep it. */
export function using<O extends { dispose(): void }, T>(object: O, visit: (object: O) => T): T {
  try {
    return visit(object);
  } finally {
    object.dispose();
  }
}
