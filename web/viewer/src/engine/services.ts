// All that can be asked of the worker. A page adds its services here, under its own name.
import type { Host } from './host';
import { operandServices } from '../operands/service';
import { discServices } from '../pages/discs/service';
import { nestingServices } from '../pages/nesting/service';
import { obstacleServices } from '../pages/obstacle/service';
import { solidServices } from '../pages/solids/service';
import { sumServices } from '../pages/sum/service';

export const services = {
  /** bytes that the module holds */
  memory: (host: Host, _: Record<never, never>): number => host.dymsum.memoryBytes(),
  ...operandServices,
  ...sumServices,
  ...obstacleServices,
  ...solidServices,
  ...discServices,
  ...nestingServices,
};

export type Services = typeof services;
export type ServiceName = keyof Services;
export type Args<K extends ServiceName> = Parameters<Services[K]>[1];
export type Answer<K extends ServiceName> = ReturnType<Services[K]>;

/** A plain function from plain data to plain data; typed arrays in it are moved, not copied. */
export type Service = (host: Host, args: never) => unknown;
services satisfies Record<string, Service>;
