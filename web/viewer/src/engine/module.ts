// What the page's module has of the package: all but what web/wasm/further/ binds, which no page calls.
import type { Dymsum } from 'dymsum';

export type PageModule = Omit<
  Dymsum,
  | 'united' | 'intersection' | 'difference' | 'symmetricDifference' | 'byPlanes' | 'byLines' | 'opening' | 'closing' | 'offset' | 'scaleRange' | 'fitRange'
  | 'SolidScaleEvents' | 'SolidRotationEvents' | 'SumLocator' | 'LocalSum' | 'PlanarLocalSum' | 'ScalingFamily'
>;
