// The 3-D view: everything that is drawn, the camera, and what happens at each time.

import { Box3, Color, DirectionalLight, Group, HemisphereLight, PerspectiveCamera, Quaternion, Scene, Sphere, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Triple } from '../data/page';
import type { FieldData, SceneData } from '../data/scene_data';
import { niceBelow } from '../data/format';
import type { VibrationData } from '../data/vibrations';
import { elastic, Motion } from '../motion/motion';
import { restOf, swing, type Drawing, type Rest } from '../motion/vibration';
import { Amplitudes, type SharedUniforms } from './bending';
import { BodyView, radiusOf } from './bodies';
import { Connections, type Layer, type Part } from './connections';
import { Annotations } from './annotations';
import { Framing, frameOf, type Cloud, type Shown } from './framing';
import { buildRoad, Grid } from './ground';
import { mapTexture, type MapName } from './palette';
import { pick, rayThrough, type Pick } from './picking';

export type ViewName = 'iso' | 'front' | 'side' | 'top';

const DIRECTIONS: Record<ViewName, Triple> = { iso: [0.78, -1, 0.55], front: [1, 0, 0.02], side: [0, -1, 0.02], top: [0, -0.001, 1] };

export interface ColourChoice {
  /** Elastic displacement (null), a field by its name, or colours of bodies (undefined). */
  field: string | null | undefined;
  range: [number, number];
  map: MapName;
}

export class Stage {
  readonly canvas = document.createElement('canvas');
  readonly renderer: WebGLRenderer;
  readonly camera = new PerspectiveCamera(32, 1, 0.01, 1000);
  readonly controls: OrbitControls;
  readonly motion: Motion;
  readonly bodies: BodyView[] = [];
  readonly connections: Connections;
  readonly annotations: Annotations;
  readonly size: number;
  readonly root = new Group();
  readonly scene: SceneData;
  readonly grid: Grid;
  readonly roads = new Group();
  deformation = 1;
  follow = -1;
  selected: { body: number; vertex: number | null } | null = null;
  /** A joint, force or rod, if one is chosen in the place of a body. */
  part: Part | null = null;
  /** Where the bodies of a model rest that swings, and how far it does. */
  readonly rest: Rest | null = null;
  amplitude = 1;
  readonly still = new Group();
  /** Moves what swings (modes of a part, vibrations of a model), at a time. */
  shape: ((time: number) => void) | null = null;
  private readonly world = new Scene();
  private readonly amplitudes: Amplitudes;
  private readonly shared: SharedUniforms;
  private readonly roadLooks: ReturnType<typeof buildRoad>[] = [];
  private readonly followed = new Vector3();
  private readonly framing: Framing;
  private readonly sky = new HemisphereLight('#ffffff', '#8d9299', 1.55);
  private readonly sun = new DirectionalLight('#ffffff', 1.9);
  private readonly fill = new DirectionalLight('#dfe9f5', 0.5);
  private dirty = true;
  private viewListeners: (() => void)[] = [];

  /** Throws if the browser gives no WebGL. */
  constructor(scene: SceneData) {
    this.scene = scene;
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true, powerPreference: 'high-performance' });
    this.motion = new Motion(scene);
    this.root.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(...scene.up).normalize(), new Vector3(0, 0, 1)));
    if (scene.vibrations.length > 0) this.rest = restOf(this.motion);
    this.amplitudes = new Amplitudes(scene.amplitudeCount, this.rest?.amplitudes ?? null);
    this.shared = { amplitudes: { value: this.amplitudes.texture }, deformation: { value: 1 }, swing: { value: 1 }, colourMap: { value: mapTexture('viridis') } };
    this.size = this.modelSize();
    // A wheel is shown by its tyre.
    const wheels = new Set(scene.forces.filter((force) => force.a >= 0 && force.picture === 'wheel').map((force) => scene.points[force.a].body));
    for (const body of scene.bodies) {
      const look = { empty: wheels.has(body.index) };
      const view = new BodyView(scene, body, this.shared, this.size, look);
      this.bodies.push(view);
      this.root.add(view.group);
      if (!this.rest) continue;
      view.place(this.motion);
      this.still.add(view.keepStill());
    }
    this.root.add(this.still);
    this.connections = new Connections(scene, this.size);
    this.annotations = new Annotations(this);
    this.framing = new Framing(() => this.shown());
    this.root.add(this.connections.root, this.roads);
    const level = this.groundLevel();
    for (const road of scene.roads) {
      let base = level;
      for (let i = 1; i < road.profile.length; i += 2) base = Math.min(base, road.profile[i] - 0.02 * this.size);
      const built = buildRoad(road, base);
      this.roadLooks.push(built);
      this.roads.add(built.group);
    }
    this.grid = new Grid(niceBelow(this.size / 6), level - (scene.roads.length > 0 ? 0.02 * this.size : 0), 14 * this.size);
    this.sun.position.set(0.45, -0.8, 1.4);
    this.fill.position.set(-0.8, 0.6, 0.25);
    this.world.add(this.root, this.grid.mesh, this.sky, this.sun, this.fill);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.16;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => {
      this.dirty = true;
      for (const listener of this.viewListeners) listener();
    });
    this.go(this.motion.scene.time[0] ?? 0);
  }

  /** What looks at the camera: scale bar, axes. */
  onView(listener: () => void): void {
    this.viewListeners.push(listener);
  }

  invalidate(): void {
    this.dirty = true;
  }

  private modelSize(): number {
    const box = new Box3();
    for (const body of this.scene.bodies) {
      const at = this.motion.toWorld(body.index, 0, 0, 0);
      const radius = radiusOf(body);
      box.union(new Sphere(new Vector3(...at), radius).getBoundingBox(new Box3()));
    }
    const points = this.scene.points.map((point) => ({ ground: point.body === -1, place: new Vector3(...this.motion.pointPosition(point, 0)) }));
    for (const { ground, place } of points) if (!ground) box.expandByPoint(place);
    // What stands far off on the ground is no part of the machine.
    const near = box.clone().expandByScalar(box.getSize(new Vector3()).length());
    for (const { ground, place } of points) if (ground && near.containsPoint(place)) box.expandByPoint(place);
    const size = box.getSize(new Vector3()).length();
    // Balls about frames are larger than what they hold.
    return size > 0 ? 0.75 * size : 1;
  }

  /** Zero where bodies stand near it, else below the lowest place of the run. */
  private groundLevel(): number {
    let lowest = Infinity;
    const radii = this.scene.bodies.map((body) => Math.min(radiusOf(body), 0.1 * this.size));
    const n = this.scene.time.length;
    const probe = new Vector3();
    for (let k = 0; k < Math.max(1, Math.min(n, 60)); ++k) {
      if (n > 0) this.motion.go(this.scene.time[Math.floor((k * (n - 1)) / Math.max(1, Math.min(n, 60) - 1))]);
      this.bodies.forEach((_, b) => {
        probe.set(...this.motion.toWorld(b, 0, 0, 0)).applyQuaternion(this.root.quaternion);
        lowest = Math.min(lowest, probe.z - radii[b]);
      });
      for (const point of this.scene.points) {
        if (point.body < 0) continue;
        probe.set(...this.motion.pointPosition(point, 0)).applyQuaternion(this.root.quaternion);
        lowest = Math.min(lowest, probe.z);
      }
    }
    if (n > 0) this.motion.go(this.scene.time[0]);
    const zero = -this.scene.origin[2];
    if (this.scene.roads.length > 0) return Math.min(...this.scene.roads.map((road) => road.profile.reduce((low, z, i) => (i % 2 ? Math.min(low, z) : low), Infinity)));
    const near = lowest >= zero - 0.12 * this.size && lowest < zero + 1.2 * this.size;
    return near ? Math.min(zero, lowest) : lowest - 0.05 * this.size;
  }

  private shown(): Shown {
    this.root.updateMatrixWorld(true);
    const { layers } = this.connections;
    return { scene: this.scene, bodies: this.bodies, deformation: this.deformation, size: this.size, tyres: layers.tyres.visible, strokes: layers.springs.visible, toView: this.root.matrixWorld };
  }

  setTheme(dark: boolean): void {
    (this.grid.material.uniforms.ink.value as Color).set(dark ? '#8b9cae' : '#5b6b7b');
    this.sky.intensity = dark ? 1.4 : 1.75;
    this.sky.groundColor.set(dark ? '#6b737c' : '#a3a9b0');
    for (const road of this.roadLooks) {
      road.surface.color.set(dark ? '#5d656e' : '#b3bac2');
      road.lines.color.set(dark ? '#a7b3bf' : '#56616c');
    }
    for (const view of this.bodies) {
      view.bending?.lines.color.set(dark ? '#0c0f12' : '#1c2329');
    }
    this.annotations.setTheme(dark);
    this.invalidate();
  }

  setColour(choice: ColourChoice): void {
    this.shared.colourMap.value = mapTexture(choice.map);
    for (const view of this.bodies) {
      const field = typeof choice.field === 'string' ? (view.data.mesh?.fields.find((f: FieldData) => f.name === choice.field) ?? undefined) : choice.field;
      view.colourBy(field, choice.range, choice.field !== undefined);
    }
    this.invalidate();
  }

  /** Deformation of a run, amplitude of what swings. */
  get scale(): number {
    return this.rest ? this.amplitude : this.deformation;
  }

  setScale(scale: number): void {
    if (this.rest) {
      this.amplitude = scale;
      this.go(this.time);
    } else this.setDeformation(scale);
  }

  /** To an angle of a vibration. */
  swing(vibration: VibrationData, drawing: Drawing, angle: number): void {
    swing(this.motion, this.rest!, vibration, drawing, this.amplitude, angle);
    this.shared.swing.value = drawing.largest * this.amplitude;
  }

  private setDeformation(scale: number): void {
    this.deformation = scale;
    this.shared.deformation.value = scale;
    this.refresh();
  }

  setLayer(layer: Layer, visible: boolean): void {
    this.connections.layers[layer].visible = visible;
    for (const listener of this.viewListeners) listener();
    this.invalidate();
  }

  setVisible(body: number, visible: boolean): void {
    const view = this.bodies[body];
    view.group.visible = visible;
    if (view.still) view.still.visible = visible;
    this.connections.hideWith((b) => this.bodies[b].group.visible);
    this.annotations.refresh();
    this.invalidate();
  }

  setFollow(body: number): void {
    this.follow = body;
    if (body >= 0) this.followed.copy(this.bodyWorld(body));
  }

  select(body: number, vertex: number | null): void {
    this.selected = body >= 0 ? { body, vertex } : null;
    this.choosePart(null);
    this.bodies.forEach((view, b) => view.setSelected(b === body));
    this.annotations.mark();
    this.invalidate();
  }

  selectPart(part: Part): void {
    this.select(-1, null);
    this.choosePart(part);
  }

  private choosePart(part: Part | null): void {
    if (part === this.part) return;
    this.part = part;
    this.connections.choose(part);
    this.invalidate();
  }

  private bodyWorld(body: number): Vector3 {
    return new Vector3(...this.motion.toWorld(body, 0, 0, 0)).applyQuaternion(this.root.quaternion);
  }

  private time = 0;

  /** All places at a time. No work per vertex. */
  go(time: number): void {
    this.time = time;
    this.motion.go(time);
    this.shape?.(time);
    this.refresh();
  }

  refresh(): void {
    this.amplitudes.set(this.motion.amplitudes);
    for (const view of this.bodies) view.place(this.motion);
    this.connections.update(this.motion, this.deformation);
    this.annotations.update();
    if (this.follow >= 0) {
      const now = this.bodyWorld(this.follow);
      const shift = now.clone().sub(this.followed);
      this.camera.position.add(shift);
      this.controls.target.add(shift);
      this.followed.copy(now);
    }
    this.invalidate();
  }

  /** Place of a vertex in the world, relative to the scene's origin, as drawn. */
  vertexPosition(body: number, vertex: number): Triple {
    const data = this.scene.bodies[body];
    const { vertices } = data.mesh!;
    const u = elastic(data, vertex, this.motion.amplitudes, data.firstMode);
    const s = this.deformation;
    return this.motion.toWorld(body, vertices[3 * vertex] + s * u[0], vertices[3 * vertex + 1] + s * u[1], vertices[3 * vertex + 2] + s * u[2]);
  }

  /** All that moves, over the whole motion; who follows a body goes on doing so. */
  fit(direction?: Vector3): void {
    const swings = this.shape !== null || this.rest !== null || this.scene.time.length < 2;
    this.hold(swings ? this.framing.present(this.motion, null) : this.framing.whole(this.follow, this.followed), 1.16, direction);
  }

  /** A body as it is now, from where the camera looks. */
  goTo(body: number): void {
    this.hold(this.framing.present(this.motion, [body]), 2.2);
  }

  private hold(cloud: Cloud, margin: number, direction?: Vector3): void {
    if (cloud.empty) return;
    const from = direction?.clone() ?? this.camera.position.clone().sub(this.controls.target);
    if (from.lengthSq() === 0) from.set(...DIRECTIONS.iso);
    from.normalize();
    // What swings goes beyond where it is: modes of a part by a tenth of its size.
    const swing = this.scene.kind === 'reduce' ? Math.max(...this.scene.bodies.map((body) => 0.08 * body.size)) : this.rest ? 0.04 * this.size : 0;
    const { target, distance } = frameOf(cloud, from, this.camera, margin, 0.05 * this.size, swing);
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(from, distance);
    this.controls.update();
    if (this.follow >= 0) this.followed.copy(this.bodyWorld(this.follow));
    for (const listener of this.viewListeners) listener();
    this.invalidate();
  }

  standard(name: ViewName): void {
    this.fit(new Vector3(...DIRECTIONS[name]));
  }

  /** False if the size is what it was. */
  resize(width: number, height: number): boolean {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    if (width <= 0 || height <= 0) return false;
    if (this.shownSize === `${width} ${height} ${ratio}`) return false;
    this.shownSize = `${width} ${height} ${ratio}`;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.annotations.resize(height, this.camera.fov);
    for (const listener of this.viewListeners) listener();
    this.invalidate();
    return true;
  }

  private shownSize = '';

  /** Metres of one pixel at the place that the camera turns about. */
  pixelSize(): number {
    const distance = this.camera.position.distanceTo(this.controls.target);
    return (2 * distance * Math.tan((this.camera.fov * Math.PI) / 360)) / Math.max(1, this.canvas.clientHeight);
  }

  /** Where a place of the scene is drawn, in pixels of the page from the upper left corner; null behind the camera. */
  pixelOf(x: number, y: number, z: number): [number, number] | null {
    this.root.updateMatrixWorld(true);
    this.camera.updateMatrixWorld();
    const p = new Vector3(x, y, z).applyMatrix4(this.root.matrixWorld).applyMatrix4(this.camera.matrixWorldInverse);
    if (p.z >= 0) return null;
    p.applyMatrix4(this.camera.projectionMatrix);
    return [((p.x + 1) / 2) * this.canvas.clientWidth, ((1 - p.y) / 2) * this.canvas.clientHeight];
  }

  /** Draws if anything changed; true if it did. */
  draw(force = false): boolean {
    this.controls.update();
    if (!this.dirty && !force) return false;
    this.dirty = false;
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = Math.max(distance / 200, 1e-5 * this.size);
    this.camera.far = 2 * distance + 30 * this.size;
    this.camera.updateProjectionMatrix();
    this.grid.focus(this.controls.target.x, this.controls.target.y);
    this.camera.updateMatrixWorld();
    this.annotations.arrange(this.camera, this.canvas.clientWidth, this.canvas.clientHeight);
    this.renderer.render(this.world, this.camera);
    return true;
  }

  pickAt(clientX: number, clientY: number): Pick | null {
    const box = this.canvas.getBoundingClientRect();
    const x = ((clientX - box.left) / box.width) * 2 - 1;
    const y = 1 - ((clientY - box.top) / box.height) * 2;
    this.root.updateMatrixWorld(true);
    return pick(this.bodies, this.motion, this.deformation, rayThrough(x, y, this.camera), this.connections.picked());
  }
}
