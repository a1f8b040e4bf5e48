// What is written and marked in the view: names, the chosen node, spiders of interfaces, frames of bodies.

import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, SphereGeometry, Vector3, type Camera } from 'three';
import type { Triple } from '../data/page';
import { Label, type Box } from './labels';
import { MARK_COLOUR } from './palette';
import type { Stage } from './stage';

const point = new Vector3();

interface Named {
  text: string;
  strong: boolean;
  bodies: number[];
  place: () => Triple;
}

export class Annotations {
  readonly root = new Group();
  readonly spiders = new Group();
  private readonly stage: Stage;
  private readonly names: Named[] = [];
  private labels: Label[] = [];
  private shown = false;
  private others = false;
  private dark = false;
  private pixel = 0.001;
  private readonly marker: Mesh;
  private readonly spiderLines: { lines: LineSegments; body: number; point: number; vertices: Uint32Array }[] = [];

  constructor(stage: Stage) {
    this.stage = stage;
    const { scene } = stage;
    for (const body of scene.bodies) {
      this.names.push({ text: body.name, strong: true, bodies: [body.index], place: () => stage.motion.toWorld(body.index, 0, 0, 0) });
    }
    for (const joint of scene.joints) {
      const point = scene.points[joint.a];
      this.names.push({ text: joint.name, strong: false, bodies: [point.body, scene.points[joint.b].body], place: () => stage.motion.pointPosition(point, stage.deformation) });
    }
    for (const force of scene.forces) {
      const index = force.a >= 0 ? force.a : force.b;
      if (index < 0) continue;
      const a = scene.points[index];
      const b = force.a >= 0 && force.b >= 0 ? scene.points[force.b] : a;
      const tyre = force.picture === 'wheel';
      this.names.push({
        text: force.name,
        strong: false,
        bodies: [a.body, b.body],
        place: () => {
          const p = stage.motion.pointPosition(a, stage.deformation);
          const q = tyre ? p : stage.motion.pointPosition(b, stage.deformation);
          return [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2];
        },
      });
    }
    if (scene.kind === 'reduce') {
      for (const point of scene.points) {
        if (point.name) this.names.push({ text: point.name, strong: false, bodies: [point.body], place: () => stage.motion.pointPosition(point, stage.deformation) });
      }
    }
    this.marker = new Mesh(new SphereGeometry(1, 20, 14), new MeshBasicMaterial({ color: MARK_COLOUR, depthTest: false, transparent: true, opacity: 0.9 }));
    this.marker.scale.setScalar(0.008 * stage.size);
    this.marker.renderOrder = 8;
    this.marker.visible = false;
    this.root.add(this.marker, this.spiders);
    this.buildSpiders();
    stage.root.add(this.root);
  }

  get nameCount(): number {
    return this.names.length;
  }

  /** Names of bodies, and of joints, forces and points. */
  setNames(bodies: boolean, others: boolean): void {
    this.shown = bodies;
    this.others = others;
    this.refresh();
  }

  setTheme(dark: boolean): void {
    if (dark === this.dark) return;
    this.dark = dark;
    for (const label of this.labels) label.dispose();
    this.labels = [];
    this.refresh();
  }

  resize(height: number, fov: number): void {
    this.pixel = (2 * Math.tan((fov * Math.PI) / 360)) / height;
    for (const label of this.labels) label.resize(this.pixel);
  }

  /** After a change of what is visible. */
  refresh(): void {
    if ((this.shown || this.others) && this.labels.length === 0) {
      this.labels = this.names.map((name) => {
        const label = new Label(name.text, this.dark, name.strong);
        label.resize(this.pixel);
        this.root.add(label.sprite);
        return label;
      });
    }
    this.labels.forEach((label, k) => {
      const bodies = this.names[k].bodies.filter((b) => b >= 0);
      label.wanted = (this.names[k].strong ? this.shown : this.others) && (bodies.length === 0 || bodies.some((b) => this.stage.bodies[b].group.visible));
    });
    this.update();
    this.stage.invalidate();
  }

  /** Names do not lie over each other: those of bodies first, others where there is room. Before each picture. */
  arrange(camera: Camera, width: number, height: number): void {
    const taken: Box[] = [];
    for (const strong of [true, false]) {
      this.labels.forEach((label, k) => {
        if (this.names[k].strong !== strong) return;
        label.sprite.visible = false;
        if (!label.wanted) return;
        label.sprite.getWorldPosition(point).project(camera);
        if (Math.abs(point.x) > 1.2 || Math.abs(point.y) > 1.2 || Math.abs(point.z) > 1) return;
        label.settle(((point.x + 1) / 2) * width, ((1 - point.y) / 2) * height, taken);
      });
    }
  }

  mark(): void {
    this.marker.visible = this.stage.selected?.vertex != null;
    this.update();
  }

  update(): void {
    if (this.shown || this.others) this.labels.forEach((label, k) => label.sprite.position.set(...this.names[k].place()));
    const chosen = this.stage.selected;
    if (chosen && chosen.vertex !== null) this.marker.position.set(...this.stage.vertexPosition(chosen.body, chosen.vertex));
    if (this.spiders.visible) this.moveSpiders();
  }

  private buildSpiders(): void {
    const material = new LineBasicMaterial({ color: '#d5803b', transparent: true, opacity: 0.8 });
    for (const body of this.stage.scene.bodies) {
      for (const { point, vertices } of body.spiders) {
        if (!this.stage.scene.points[point]) continue;
        const geometry = new BufferGeometry();
        geometry.setAttribute('position', new BufferAttribute(new Float32Array(6 * vertices.length), 3));
        const lines = new LineSegments(geometry, material);
        lines.frustumCulled = false;
        this.spiders.add(lines);
        this.spiderLines.push({ lines, body: body.index, point, vertices });
      }
    }
    const ball = new SphereGeometry(0.006 * this.stage.size, 18, 12);
    if (this.stage.scene.kind !== 'reduce') return;
    for (const point of this.stage.scene.points) {
      const mesh = new Mesh(ball, new MeshBasicMaterial({ color: '#d5803b' }));
      mesh.userData.point = point;
      this.spiders.add(mesh);
    }
  }

  /** Legs end at vertices that the shader moves; there are few of them. */
  private moveSpiders(): void {
    for (const { lines, body, point, vertices } of this.spiderLines) {
      const hub = this.stage.motion.pointPosition(this.stage.scene.points[point], this.stage.deformation);
      const attribute = lines.geometry.getAttribute('position') as BufferAttribute;
      for (let k = 0; k < vertices.length; ++k) {
        attribute.setXYZ(2 * k, ...hub);
        attribute.setXYZ(2 * k + 1, ...this.stage.vertexPosition(body, vertices[k]));
      }
      attribute.needsUpdate = true;
    }
    for (const object of this.spiders.children) {
      const point = object.userData.point as Parameters<Stage['motion']['pointPosition']>[0] | undefined;
      if (point) object.position.set(...this.stage.motion.pointPosition(point, this.stage.deformation));
    }
  }
}
