// Files that are dropped on the page or chosen.
import { useEffect, useState } from 'preact/hooks';
import type { InputFile } from './page';

export const kAccepted = '.poly,.wkt,.geojson,.svg,.json,.dxf,.off,.obj,.stl,.ply,.obstacle';

async function read(list: FileList): Promise<InputFile[]> {
  return await Promise.all([...list].map(async (f) => ({ name: f.name, bytes: new Uint8Array(await f.arrayBuffer()) })));
}

export function chooseFiles(take: (files: InputFile[]) => void): void {
  const input = Object.assign(document.createElement('input'), { type: 'file', multiple: true, accept: kAccepted });
  input.onchange = () => {
    if (input.files?.length) void read(input.files).then(take);
  };
  input.click();
}

/** Whether files hover over the page. */
export function useDroppedFiles(take: (files: InputFile[]) => void): boolean {
  const [over, setOver] = useState(false);
  useEffect(() => {
    const hasFiles = (e: DragEvent): boolean => e.dataTransfer?.types.includes('Files') ?? false;
    const onOver = (e: DragEvent): void => {
      if (!hasFiles(e)) return;
      e.preventDefault();
      setOver(true);
    };
    const onLeave = (e: DragEvent): void => {
      if (!e.relatedTarget) setOver(false);
    };
    const onDrop = (e: DragEvent): void => {
      if (!hasFiles(e)) return;
      e.preventDefault();
      setOver(false);
      void read(e.dataTransfer!.files).then(take);
    };
    addEventListener('dragover', onOver);
    addEventListener('dragleave', onLeave);
    addEventListener('drop', onDrop);
    return () => {
      removeEventListener('dragover', onOver);
      removeEventListener('dragleave', onLeave);
      removeEventListener('drop', onDrop);
    };
  }, [take]);
  return over;
}
