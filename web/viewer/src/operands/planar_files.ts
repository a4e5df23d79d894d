// Which files planar pages take.
import { shapeOfFile, type FileShape, type Shape } from '../engine/shape';
import type { InputFile } from '../shell/page';
import { checkContents } from './content';

const kPlanar = /\.(poly|wkt|geojson|svg|json|dxf)$/i;

/** Throws an Error that names the first file that holds no region, or says that there are too many. */
export function planarShapes(files: readonly InputFile[], most: number): FileShape[] {
  const other = files.find((f) => !kPlanar.test(f.name));
  if (other) throw new Error(`"${other.name}" holds no region: this page takes .poly, .wkt, .geojson, .svg, .dxf and .json.`);
  if (files.length > most) throw new Error(`${files.length} files are too many: this page takes ${most === 1 ? 'one' : `up to ${most}`}.`);
  checkContents(files);
  return files.map(shapeOfFile);
}

/** Whether files are new versions of what is shown, as a server hands over what was saved: all else then stays as it is. */
export function areAgain(files: readonly FileShape[], shown: readonly Shape[]): boolean {
  return files.length === shown.length && files.every((file, k) => file.name === shown[k]!.name);
}
