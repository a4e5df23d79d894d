// Files out of the page, and text to the clipboard.
import type { Download } from './page';

const kTypes: Record<string, string> = { svg: 'image/svg+xml', json: 'application/json', glb: 'model/gltf-binary', wkt: 'text/plain' };

export async function save({ fileName, make }: Download): Promise<void> {
  const content = await make();
  const type = kTypes[fileName.split('.').pop() ?? ''] ?? 'application/octet-stream';
  const url = URL.createObjectURL(new Blob([content as BlobPart], { type }));
  const link = Object.assign(document.createElement('a'), { href: url, download: fileName });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

/** Pages from disk may not be allowed to use the clipboard's interface: then by a selection. */
export async function copy(text: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = Object.assign(document.createElement('textarea'), { value: text });
    document.body.append(area);
    area.select();
    document.execCommand('copy'); // eslint-disable-line @typescript-eslint/no-deprecated -- the only other way
    area.remove();
  }
}
