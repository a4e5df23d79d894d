import { useEffect, useState } from 'preact/hooks';

/** The value once it has not changed for a while; until then nothing. */
export function useSettled<T>(value: T, ms = 250): T | undefined {
  const [settled, setSettled] = useState<{ of: T } | undefined>();
  useEffect(() => {
    const timer = setTimeout(() => setSettled({ of: value }), ms);
    return () => clearTimeout(timer);
  }, [value, ms]);
  return settled && Object.is(settled.of, value) ? value : undefined;
}
