import { describe, expect, it } from 'vitest';
import { dataFromHash, fromHash, toHash } from './permalink';

describe('permalinks', () => {
  it('come back as they went', async () => {
    const document = { page: 'sum', state: { text: 'POLYGON ((0 0, 1 0, 0 1)) ⊕ '.repeat(2000), at: [0.1, -1e300], none: null } };
    const hash = await toHash(document);
    expect(hash).toMatch(/^#\/sum\/[\w-]+$/);
    expect(hash.length).toBeLessThan(1000);
    expect(await fromHash(hash)).toEqual(document);
  });
  it('may name a page alone, or nothing', async () => {
    expect(await fromHash('#/discs')).toEqual({ page: 'discs', state: undefined });
    expect(await fromHash('')).toBeUndefined();
    expect(await fromHash('#section')).toBeUndefined();
  });
  it('that something was added to say so', async () => {
    const hash = await toHash({ page: 'sum', state: { a: [1, 2, 3] } });
    for (const after of ['%%%%', '==', '?x=1', '#/sum', '/', ' ']) await expect(fromHash(hash + after)).rejects.toThrow('damaged');
    await expect(fromHash('#/sum?x=1')).rejects.toThrow('damaged');
    await expect(dataFromHash('#data=%%')).rejects.toThrow('damaged');
    await expect(dataFromHash('#data=')).rejects.toThrow('damaged');
    expect([await fromHash('#/'), await fromHash('#data=AA'), await dataFromHash('#/sum')]).toEqual([undefined, undefined, undefined]);
    expect(await fromHash('#/sum/')).toEqual({ page: 'sum', state: undefined });
  });
  it('that are damaged say so', async () => {
    const hash = await toHash({ page: 'sum', state: { a: [1, 2, 3] } });
    await expect(fromHash(hash.slice(0, -4))).rejects.toThrow('damaged');
    await expect(fromHash('#/sum/AAAA')).rejects.toThrow('damaged');
  });
});
