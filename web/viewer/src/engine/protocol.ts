// Messages between the page and the worker.
import type { ErrorCode, Evidence } from 'dymsum';

export interface ErrorData {
  /** the library's, or a limit of the pages or of the browser */
  code: ErrorCode | 'limit';
  reason: string;
  message: string;
  evidence: Evidence;
}

export interface Request {
  id: number;
  service: string;
  args: unknown;
}
/** Sent once, before any request: the module as it stands in the page, xz in base64. */
export interface Start {
  wasm: string;
  simd: boolean;
}
export type Reply =
  | { kind: 'answer'; id: number; value: unknown }
  | { kind: 'error'; id: number; error: ErrorData }
  | { kind: 'progress'; id: number; stage: string; fraction: number }
  | { kind: 'ready'; version: string; simd: boolean }
  | { kind: 'broken'; code: ErrorData['code']; message: string };
