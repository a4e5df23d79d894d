// three.js from its sources, without what no picture here has: other materials, textures in space, shadows and headsets, a
// sixth of its code. Shaders ask for parts by name: one that is left out is empty, and what a material of ours needs must stay.
import type { Plugin } from 'vite';

const kShader = /\/three\/src\/renderers\/shaders\/(ShaderLib|ShaderChunk)\/(\w+)\.glsl\.js$/;
const kLeftOut = {
  ShaderLib: ['background', 'backgroundCube', 'cube', 'depth', 'distanceRGBA', 'equirect', 'linedashed', 'meshmatcap', 'meshnormal', 'meshphong', 'meshphysical', 'meshtoon', 'points', 'shadow', 'sprite'],
  ShaderChunk: [
    'alphahash_pars_fragment', 'bumpmap_pars_fragment', 'cube_uv_reflection_fragment', 'envmap_physical_pars_fragment', 'iridescence_fragment', 'lights_phong_fragment', 'lights_phong_pars_fragment',
    'lights_physical_fragment', 'lights_physical_pars_fragment', 'lights_toon_fragment', 'lights_toon_pars_fragment', 'shadowmap_pars_fragment', 'shadowmap_pars_vertex', 'shadowmap_vertex', 'tonemapping_pars_fragment', 'transmission_fragment', 'transmission_pars_fragment',
  ],
};

/** What stands in for a file: what the renderer asks of it where there is nothing of its kind. */
const kInstead: Record<string, string> = {
  'webxr/WebXRManager': `
    import { EventDispatcher } from '../../core/EventDispatcher.js';
    export class WebXRManager extends EventDispatcher {
      enabled = false;
      isPresenting = false;
      setAnimationLoop() {}
      getEnvironmentBlendMode() {}
      dispose() {}
    }`,
  'webgl/WebGLShadowMap': 'export function WebGLShadowMap() { return { enabled: false, autoUpdate: true, needsUpdate: false, type: 1, render() {} }; }',
  'webgl/WebGLCubeMaps': 'export function WebGLCubeMaps() { return { get: (texture) => texture, dispose() {} }; }',
  'webgl/WebGLCubeUVMaps': 'export function WebGLCubeUVMaps() { return { get: (texture) => texture, dispose() {} }; }',
  'webgl/WebGLMorphtargets': 'export function WebGLMorphtargets() { return { update() {} }; }',
};

function standIn(id: string): [name: string, code: string] | undefined {
  const [, kind, shader] = kShader.exec(id) ?? [];
  if (kind && shader && kLeftOut[kind as keyof typeof kLeftOut].includes(shader))
    return [`${kind}/${shader}`, kind === 'ShaderLib' ? "export const vertex = '', fragment = '';" : "export default '';"];
  const name = Object.keys(kInstead).find((file) => id.endsWith(`/three/src/renderers/${file}.js`));
  return name === undefined ? undefined : [name, kInstead[name]!];
}

export function threeParts(): Plugin {
  const all = [...Object.entries(kLeftOut).flatMap(([kind, shaders]) => shaders.map((shader) => `${kind}/${shader}`)), ...Object.keys(kInstead)], found = new Set<string>();
  return {
    name: 'three-parts',
    enforce: 'pre',
    apply: 'build',
    config: () => ({ resolve: { alias: [{ find: /^three$/, replacement: 'three/src/Three.js' }] } }),
    load(id) {
      const [name, code] = standIn(id) ?? [];
      if (name === undefined) return undefined;
      found.add(name);
      return { code: code!, map: null };
    },
    buildEnd(error) {
      const missing = all.filter((name) => !found.has(name));
      if (!error && missing.length > 0) throw new Error(`three.js has no ${missing.join(', ')}: three_parts.ts is of another version.`);
    },
  };
}
