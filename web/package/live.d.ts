/** dymsum without the command line, for pages: smaller by the half. Everything is as index.d.ts tells. */
import type { Live, LoadOptions } from './index.js';

export * from './index.js';
export type { Live as Dymsum } from './index.js';
export function load(options?: Omit<LoadOptions, 'commandBinary'>): Promise<Live>;
