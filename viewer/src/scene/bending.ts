// Materials of flexible bodies: modes are blended in the vertex shader.
//
// Texel (vertex * modes + mode) of a texture of half floats holds the displacement of a vertex at amplitude one. The amplitudes of
// all bodies are one small texture, the only thing that changes from frame to frame. Normals: the fragment shader knows the plane of
// its triangle at rest and bent (derivatives of the interpolated places); the turn from one to the other is given to the smooth normal.

import {
  DataTexture,
  DoubleSide,
  FloatType,
  HalfFloatType,
  LineBasicMaterial,
  Matrix4,
  MeshPhongMaterial,
  NearestFilter,
  RedFormat,
  RGBAFormat,
  type IUniform,
  type Material,
  type Texture,
} from 'three';
import type { BodyData, FieldData, MeshData } from '../data/scene_data';
import { STILL_COLOUR } from './palette';

const WIDTH_BITS = 12;
const WIDTH = 1 << WIDTH_BITS;
const AMPLITUDE_BITS = 8;
const HALF_ONE = 0x3c00;

function texture(data: Uint16Array | Float32Array, width: number, height: number, format: typeof RGBAFormat | typeof RedFormat): DataTexture {
  const result = new DataTexture(data as never, width, height, format, data instanceof Float32Array ? FloatType : HalfFloatType);
  result.magFilter = NearestFilter;
  result.minFilter = NearestFilter;
  result.needsUpdate = true;
  return result;
}

/** Half floats in rows of WIDTH texels, `parts` numbers given for each texel. */
function halfTexture(values: Uint16Array, parts: 1 | 3): DataTexture {
  const texels = values.length / parts;
  const width = Math.min(WIDTH, Math.max(1, texels));
  const height = Math.max(1, Math.ceil(texels / WIDTH));
  if (parts === 1) {
    const data = new Uint16Array(width * height);
    data.set(values);
    return texture(data, width, height, RedFormat);
  }
  const data = new Uint16Array(4 * width * height);
  for (let i = 0, from = 0, to = 0; i < texels; ++i, from += 3, to += 4) {
    data[to] = values[from];
    data[to + 1] = values[from + 1];
    data[to + 2] = values[from + 2];
  }
  return texture(data, width, height, RGBAFormat);
}

/** Half floats in pairs of texels, six numbers given for each pair. */
function tensorTexture(values: Uint16Array): DataTexture {
  const texels = values.length / 3;
  const width = Math.min(WIDTH, Math.max(1, texels));
  const data = new Uint16Array(4 * width * Math.max(1, Math.ceil(texels / WIDTH)));
  for (let i = 0; i < texels; ++i) data.set(values.subarray(3 * i, 3 * i + 3), 4 * i);
  return texture(data, width, data.length / (4 * width), RGBAFormat);
}

function floatTexture(values: Float32Array): DataTexture {
  const width = Math.min(WIDTH, Math.max(1, values.length));
  const data = new Float32Array(width * Math.max(1, Math.ceil(values.length / WIDTH)));
  data.set(values);
  return texture(data, width, data.length / width, RedFormat);
}

export class Amplitudes {
  readonly texture: DataTexture;
  private readonly data: Float32Array;

  /** Those of the model at rest stand behind the present ones, if there are any. */
  constructor(count: number, still: Float32Array | null) {
    const width = 1 << AMPLITUDE_BITS;
    this.data = new Float32Array(width * Math.max(1, Math.ceil((still ? 2 * count : count) / width)));
    if (still) this.data.set(still.subarray(0, count), count);
    this.texture = texture(this.data, width, this.data.length / width, RedFormat);
  }

  set(values: Float32Array): void {
    this.data.set(values);
    this.texture.needsUpdate = true;
  }
}

export interface SharedUniforms {
  amplitudes: IUniform<Texture>;
  deformation: IUniform<number>;
  /** Largest displacement of the vibration that is drawn. */
  swing: IUniform<number>;
  colourMap: IUniform<Texture>;
}

export interface BendingUniforms extends Record<string, IUniform> {
  modeCount: IUniform<number>;
  scalarKind: IUniform<number>;
  scalarRange: IUniform<[number, number]>;
}

const VERTEX_DECLARATIONS = `
attribute float source;
uniform highp sampler2D modeTexture;
uniform highp sampler2D amplitudeTexture;
uniform highp sampler2D fieldTexture;
uniform highp sampler2D fieldBase;
uniform int modeCount;
uniform int firstMode;
uniform int loadCount;
uniform int firstLoad;
uniform int vertexCount;
uniform int scalarKind;
uniform vec2 fieldFrame;
uniform float fieldFactor;
uniform float deformation;
uniform int stillMode;
uniform mat4 away;
uniform float swing;
varying vec3 restPlace;
varying float scalarValue;
varying float doubt;
float amplitudeAt(int i) {
  return texelFetch(amplitudeTexture, ivec2(i & ${(1 << AMPLITUDE_BITS) - 1}, i >> ${AMPLITUDE_BITS}), 0).r;
}
float amplitude(int j) { return amplitudeAt(firstMode + j); }
ivec2 texel(int i) { return ivec2(i & ${WIDTH - 1}, i >> ${WIDTH_BITS}); }
// Of xx, yy, zz and xy, yz, zx; motion/stress.ts has the same.
float vonMises(vec3 n, vec3 t) {
  vec3 d = n - n.yzx;
  return sqrt(0.5 * dot(d, d) + 3.0 * dot(t, t));
}
float principal(vec3 n, vec3 t, float turn) {
  float mean = (n.x + n.y + n.z) / 3.0;
  vec3 d = n - mean;
  float p = sqrt((dot(d, d) + 2.0 * dot(t, t)) / 6.0);
  if (!(p > 0.0)) return mean;
  d /= p;
  vec3 e = t / p;
  float determinant = d.x * (d.y * d.z - e.y * e.y) - e.x * (e.x * d.z - e.y * e.z) + e.z * (e.x * e.y - d.y * e.z);
  return mean + 2.0 * p * cos(acos(clamp(0.5 * determinant, -1.0, 1.0)) / 3.0 + turn);
}
`;

const VERTEX_BEGIN = `
vec3 transformed = position;
{
  int vertex = int(source + 0.5);
  int first = vertex * modeCount;
  vec3 bent = vec3(0.0);
  for (int j = 0; j < modeCount; ++j) bent += amplitude(j) * texelFetch(modeTexture, texel(first + j), 0).xyz;
  transformed += deformation * bent;
  restPlace = (modelViewMatrix * vec4(position, 1.0)).xyz;
  scalarValue = length(bent);
  doubt = scalarKind >= 5 ? texelFetch(fieldBase, texel(vertex), 0).r : 0.0;
  if (scalarKind == 2) {
    scalarValue = texelFetch(fieldBase, texel(vertex), 0).r;
    for (int j = 0; j < modeCount; ++j) scalarValue += amplitude(j) * texelFetch(fieldTexture, texel(first + j), 0).r;
  } else if (scalarKind == 3) {
    int at = int(fieldFrame.x) * vertexCount + vertex;
    float a = texelFetch(fieldTexture, texel(at), 0).r;
    float b = fieldFrame.y > 0.0 ? texelFetch(fieldTexture, texel(at + vertexCount), 0).r : a;
    scalarValue = mix(a, b, fieldFrame.y);
  } else if (scalarKind == 4) {
    vec3 still = position;
    for (int j = 0; j < modeCount; ++j) still += amplitudeAt(stillMode + j) * texelFetch(modeTexture, texel(first + j), 0).xyz;
    scalarValue = length((away * vec4(transformed, 1.0)).xyz - still) / max(swing, 1e-30);
  } else if (scalarKind >= 5 && scalarKind <= 7) {
    vec3 n = vec3(0.0), t = vec3(0.0);
    int tensor = 2 * vertex * (modeCount + loadCount);
    for (int j = 0; j < modeCount + loadCount; ++j, tensor += 2) {
      float q = j < modeCount ? amplitude(j) : amplitudeAt(firstLoad + j - modeCount);
      n += q * texelFetch(fieldTexture, texel(tensor), 0).xyz;
      t += q * texelFetch(fieldTexture, texel(tensor + 1), 0).xyz;
    }
    scalarValue = fieldFactor * (scalarKind == 5 ? vonMises(n, t) : principal(n, t, scalarKind == 6 ? 0.0 : 2.0943951023931953));
  } else if (scalarKind == 8) {
    scalarValue = texelFetch(fieldTexture, texel(vertex), 0).r;
  }
}
`;

const FRAGMENT_DECLARATIONS = `
varying vec3 restPlace;
varying float scalarValue;
varying float doubt;
uniform int scalarKind;
uniform vec2 scalarRange;
uniform sampler2D colourMap;
`;

const FRAGMENT_COLOUR = `
if (scalarKind > 0) {
  float part = clamp((scalarValue - scalarRange.x) / max(scalarRange.y - scalarRange.x, 1e-30), 0.0, 1.0);
  diffuseColor.rgb = mix(texture2D(colourMap, vec2((part * 255.0 + 0.5) / 256.0, 0.5)).rgb, vec3(0.5), doubt);
}
`;

const FRAGMENT_NORMAL = `
{
  vec3 before = cross(dFdx(restPlace), dFdy(restPlace));
  vec3 after = cross(dFdx(-vViewPosition), dFdy(-vViewPosition));
  float sizes = length(before) * length(after);
  if (sizes > 0.0) {
    vec3 turn = cross(before, after) / sizes;
    float c = dot(before, after) / sizes;
    if (c > -0.99) normal = normalize(normal * c + cross(turn, normal) + turn * dot(turn, normal) / (1.0 + c));
  }
}
`;

const none = texture(new Uint16Array(1), 1, 1, RedFormat);

export class Bending {
  readonly uniforms: BendingUniforms;
  readonly surface: MeshPhongMaterial;
  /** 1: elastic; 4: from where the model rests. */
  private readonly displacement: number;
  readonly lines: LineBasicMaterial;
  /** Lines of the body at rest. */
  readonly stillLines: LineBasicMaterial | null = null;
  private readonly fields = new Map<FieldData, Texture>();
  private readonly bases = new Map<FieldData, Texture>();
  private doubts: Texture | null = null;
  private readonly stresses = new Map<Uint16Array | Float32Array, Texture>();

  /** `still`: where the amplitudes at rest begin, of a model that swings. */
  constructor(body: BodyData, mesh: MeshData, shared: SharedUniforms, colour: string, still: number | null) {
    this.uniforms = {
      modeTexture: { value: mesh.modes ? halfTexture(mesh.modes, 3) : none },
      amplitudeTexture: shared.amplitudes,
      fieldTexture: { value: none },
      fieldBase: { value: none },
      modeCount: { value: mesh.modes ? body.modeCount : 0 },
      firstMode: { value: body.firstMode },
      loadCount: { value: mesh.stress?.loadCount ?? 0 },
      firstLoad: { value: mesh.stress?.firstLoad ?? 0 },
      vertexCount: { value: mesh.vertices.length / 3 },
      scalarKind: { value: 0 },
      scalarRange: { value: [0, 1] },
      fieldFrame: { value: [0, 0] },
      fieldFactor: { value: 1 },
      deformation: shared.deformation,
      colourMap: shared.colourMap,
      stillMode: { value: (still ?? 0) + body.firstMode },
      away: { value: new Matrix4() },
      swing: shared.swing,
    };
    this.displacement = still === null ? 1 : 4;
    this.surface = new MeshPhongMaterial({ color: colour, specular: '#1d1f22', shininess: 28, side: DoubleSide });
    // The surface lies a little behind its edges.
    this.surface.polygonOffset = true;
    this.surface.polygonOffsetFactor = 1;
    this.surface.polygonOffsetUnits = 1;
    this.inject(this.surface, true, this.uniforms);
    this.lines = new LineBasicMaterial({ color: '#1c2329', transparent: true, opacity: 0.45 });
    this.inject(this.lines, false, this.uniforms);
    if (still === null) return;
    this.stillLines = new LineBasicMaterial({ color: STILL_COLOUR, transparent: true, opacity: 0.55 });
    this.inject(this.stillLines, false, { ...this.uniforms, firstMode: this.uniforms.stillMode });
  }

  /** Colours by displacement (null), a field of the body, or none (undefined). */
  colourBy(field: FieldData | null | undefined, range: [number, number]): void {
    this.uniforms.scalarRange.value = range;
    if (field === undefined) this.uniforms.scalarKind.value = 0;
    else if (field === null) this.uniforms.scalarKind.value = this.displacement;
    else if (field.stress) {
      const { data, quantity } = field.stress;
      // The tensor is one texture for all that is made of it.
      const key = quantity === 'envelope' ? data.envelope! : data.modes;
      if (!this.stresses.has(key)) this.stresses.set(key, quantity === 'envelope' ? floatTexture(data.envelope!) : tensorTexture(data.modes));
      this.uniforms.fieldTexture.value = this.stresses.get(key)!;
      // Grey where it is not to be trusted.
      this.doubts ??= halfTexture(Uint16Array.from(data.doubtful ?? new Uint8Array(this.uniforms.vertexCount.value), (flag) => (flag ? HALF_ONE : 0)), 1);
      this.uniforms.fieldBase.value = this.doubts;
      this.uniforms.fieldFactor.value = data.factor;
      this.uniforms.scalarKind.value = { von_mises: 5, principal_1: 6, principal_3: 7, envelope: 8 }[quantity];
    } else {
      if (!this.fields.has(field)) {
        this.fields.set(field, halfTexture((field.modes ?? field.history)!, 1));
        this.bases.set(field, field.base ? halfTexture(field.base, 1) : halfTexture(new Uint16Array(this.uniforms.vertexCount.value), 1));
      }
      this.uniforms.fieldTexture.value = this.fields.get(field)!;
      this.uniforms.fieldBase.value = this.bases.get(field)!;
      this.uniforms.scalarKind.value = field.modes ? 2 : 3;
    }
  }

  setFrame(frame: number, part: number): void {
    const value = this.uniforms.fieldFrame.value as [number, number];
    value[0] = frame;
    value[1] = part;
  }

  private inject(material: Material, shaded: boolean, uniforms: Record<string, IUniform>): void {
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, uniforms);
      shader.vertexShader = VERTEX_DECLARATIONS + shader.vertexShader.replace('#include <begin_vertex>', VERTEX_BEGIN);
      if (!shaded) return;
      shader.fragmentShader =
        FRAGMENT_DECLARATIONS +
        shader.fragmentShader
          .replace('#include <color_fragment>', `#include <color_fragment>\n${FRAGMENT_COLOUR}`)
          .replace('#include <normal_fragment_begin>', `#include <normal_fragment_begin>\n${FRAGMENT_NORMAL}`);
    };
    material.customProgramCacheKey = () => (shaded ? 'bending surface' : 'bending lines');
  }
}
