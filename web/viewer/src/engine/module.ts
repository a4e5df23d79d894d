// What the page's module has of the package: all but what web/wasm/further/ binds, which no page calls.
import type { Dymsum, ScalingFamily } from 'dymsum';

export type PageFamily = Omit<ScalingFamily, 'outer' | 'inner'>;

export type PageModule = Omit<
  Dymsum,
  | 'united' | 'intersection' | 'difference' | 'symmetricDifference' | 'byPlanes' | 'byLines' | 'opening' | 'closing' | 'offset' | 'scaleRange' | 'fitRange'
  | 'SolidScaleEvents' | 'SolidRotationEvents' | 'SumLocator' | 'LocalSum' | 'PlanarLocalSum' | 'EditableSum' | 'ScalingFamily'
> & { readonly ScalingFamily: { create(...args: Parameters<Dymsum['ScalingFamily']['create']>): PageFamily } };
