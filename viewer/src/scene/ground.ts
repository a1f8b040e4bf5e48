// The grid of the ground and the roads.

import { BufferAttribute, BufferGeometry, Color, DoubleSide, Group, LineBasicMaterial, LineSegments, Mesh, MeshPhongMaterial, PlaneGeometry, ShaderMaterial, Vector3 } from 'three';
import type { RoadData } from '../data/scene_data';

/** A plane of lines that fades with the distance from the camera's target. */
export class Grid {
  readonly mesh: Mesh;
  readonly material: ShaderMaterial;

  constructor(cell: number, level: number, reach: number) {
    this.material = new ShaderMaterial({
      transparent: true,
      depthWrite: false,
      side: DoubleSide,
      uniforms: { cell: { value: cell }, reach: { value: reach }, focus: { value: new Vector3() }, ink: { value: new Color('#5b6b7b') } },
      vertexShader: `
        varying vec3 at;
        void main() {
          vec4 world = modelMatrix * vec4(position, 1.0);
          at = world.xyz;
          gl_Position = projectionMatrix * viewMatrix * world;
        }`,
      fragmentShader: `
        varying vec3 at;
        uniform float cell;
        uniform float reach;
        uniform vec3 focus;
        uniform vec3 ink;
        float lines(float size) {
          vec2 p = at.xy / size;
          vec2 width = fwidth(p);
          vec2 distance = abs(fract(p - 0.5) - 0.5) / max(width, vec2(1e-6));
          // Where cells become smaller than pixels, nothing is left.
          vec2 seen = clamp(1.0 - width * 2.0, 0.0, 1.0);
          vec2 line = (1.0 - clamp(distance - 0.25, 0.0, 1.0)) * seen;
          return max(line.x, line.y);
        }
        void main() {
          float fade = 1.0 - smoothstep(0.25, 1.0, length(at.xy - focus.xy) / reach);
          float alpha = max(0.2 * lines(cell), 0.36 * lines(10.0 * cell)) * fade;
          if (alpha < 0.004) discard;
          gl_FragColor = vec4(ink, alpha);
        }`,
    });
    this.mesh = new Mesh(new PlaneGeometry(2 * reach, 2 * reach), this.material);
    this.mesh.position.z = level;
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = -1;
  }

  focus(x: number, y: number): void {
    (this.material.uniforms.focus.value as Vector3).set(x, y, 0);
    this.mesh.position.x = x;
    this.mesh.position.y = y;
  }
}

/** A ribbon along x and z, as wide as given along y, with walls down to `base`. */
export function buildRoad(road: RoadData, base: number): { group: Group; surface: MeshPhongMaterial; lines: LineBasicMaterial } {
  const { profile, width } = road;
  const n = profile.length / 2;
  const [left, right] = [Math.min(...width), Math.max(...width)];
  const triangles: number[] = [];
  const quad = (a: number[], b: number[], c: number[], d: number[]): void => {
    triangles.push(...a, ...b, ...c, ...a, ...c, ...d);
  };
  const edges: number[] = [];
  for (let i = 0; i + 1 < n; ++i) {
    const [x0, z0, x1, z1] = profile.subarray(2 * i, 2 * i + 4);
    quad([x0, left, z0], [x1, left, z1], [x1, right, z1], [x0, right, z0]);
    for (const y of [left, right]) {
      quad([x0, y, z0], [x1, y, z1], [x1, y, base], [x0, y, base]);
      edges.push(x0, y, z0, x1, y, z1);
    }
  }
  // A line across wherever the road breaks.
  for (let i = 1; i + 1 < n; ++i) {
    const before = Math.atan2(profile[2 * i + 1] - profile[2 * i - 1], profile[2 * i] - profile[2 * i - 2]);
    const after = Math.atan2(profile[2 * i + 3] - profile[2 * i + 1], profile[2 * i + 2] - profile[2 * i]);
    if (Math.abs(after - before) > 0.1) edges.push(profile[2 * i], left, profile[2 * i + 1], profile[2 * i], right, profile[2 * i + 1]);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(Float32Array.from(triangles), 3));
  geometry.computeVertexNormals();
  const surface = new MeshPhongMaterial({ color: '#8b939c', specular: '#000000', side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 });
  const lines = new LineBasicMaterial({ color: '#3d4650', transparent: true, opacity: 0.7 });
  const line = new BufferGeometry();
  line.setAttribute('position', new BufferAttribute(Float32Array.from(edges), 3));
  const group = new Group();
  group.name = road.name;
  group.add(new Mesh(geometry, surface), new LineSegments(line, lines));
  return { group, surface, lines };
}
