import { describe, expect, it } from 'vitest';
import { filesOf, programData } from './embedded';

const kData = { format: 1, page: 'sum', live: true, revision: 3, inputs: [], parameters: { verb: 'view' } };

describe('data of the program', () => {
  it('may be absent', () => {
    expect(programData('')).toBeUndefined();
    expect(programData(' \n')).toBeUndefined();
  });
  it('is read as it is', () => expect(programData(JSON.stringify(kData))).toEqual(kData));
  it('of the gallery names no page', () => {
    const data = programData(JSON.stringify({ ...kData, page: 'home' }));
    expect(data).not.toHaveProperty('page');
    expect(data).toHaveProperty('gallery', true);
  });
  it('of another format is refused', () => {
    expect(() => programData(JSON.stringify({ ...kData, format: 2 }))).toThrow('has format 2');
    expect(() => programData('{}')).toThrow('has format undefined');
  });
  it('holds texts and bytes', () => {
    const files = filesOf({ inputs: [{ name: 'a.wkt', text: 'POINT (1 ½)' }, { name: 'b.stl', base64: 'AP8=' }] });
    expect(files.map((f) => [f.name, ...f.bytes])).toEqual([['a.wkt', ...new TextEncoder().encode('POINT (1 ½)')], ['b.stl', 0, 255]]);
  });
});
