// What is drawn of each body, in a group that has the body's frame.

import { Box3, BufferAttribute, type BufferGeometry, Color, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh, type MeshPhongMaterial, Vector3 } from 'three';
import type { BodyData, FieldData, MeshData, SceneData } from '../data/scene_data';
import type { Motion } from '../motion/motion';
import { Bending, type SharedUniforms } from './bending';
import { BODY_COLOURS, STILL_COLOUR } from './palette';
import { buildSolid, buildSticks } from './solids';
import { buildSurface } from './surface';
import { buildTriad, plain } from './symbols';

const HIGHLIGHT = new Color('#2f81c7');
const NEUTRAL = new Color('#9ba3ab');
const WHITE = new Color('#ffffff');

export class BodyView {
  readonly group = new Group();
  readonly data: BodyData;
  readonly bending: Bending | null = null;
  readonly mesh: Mesh | null = null;
  readonly colour: Color;
  triad: Group | null = null;
  /** Outlines where the body rests, of a model that swings. */
  still: Group | null = null;
  private back: Matrix4 | null = null;
  private readonly material: MeshPhongMaterial;
  private readonly lines: LineSegments | null = null;
  /** The undeformed body in its frame; empty where nothing is drawn of it. */
  readonly restBox = new Box3();

  constructor(scene: SceneData, body: BodyData, shared: SharedUniforms, modelSize: number, look: { empty: boolean }) {
    this.data = body;
    this.colour = new Color(body.mesh?.colour ?? BODY_COLOURS[body.index % BODY_COLOURS.length]);
    const colour = `#${this.colour.getHexString()}`;
    this.group.name = body.name;
    if (body.mesh) {
      const surface = buildSurface(body.mesh);
      this.bending = new Bending(body, body.mesh, shared, colour, scene.vibrations.length > 0 ? scene.amplitudeCount : null);
      this.material = this.bending.surface;
      this.mesh = new Mesh(surface.geometry, this.material);
      this.mesh.frustumCulled = false;
      this.lines = new LineSegments(surface.edges, this.bending.lines);
      this.lines.frustumCulled = false;
      this.group.add(this.mesh, this.lines);
      if (body.mesh.paints.length > 0) paint(surface.geometry, body.mesh, this.colour, this.material);
      this.restBox.copy(surface.geometry.boundingBox!);
    } else if (look.empty) {
      this.material = plain(colour);
    } else {
      this.material = plain(colour);
      const lines = new LineBasicMaterial({ color: '#1c2329', transparent: true, opacity: 0.35 });
      const solid = body.solid
        ? buildSolid(body.solid, this.material, lines)
        : buildSticks(
            scene.points.filter((point) => point.body === body.index).map((point) => point.p),
            0.006 * modelSize,
            this.material,
          );
      this.group.add(solid);
      this.measure();
      if (body.solid) this.setGhost(true);
    }
  }

  get flexible(): boolean {
    return this.bending !== null && this.data.mesh?.modes !== null && this.data.modeCount > 0;
  }

  /** It is seen through. */
  get glass(): boolean {
    return this.material.transparent && this.material.opacity < 0.9;
  }

  /** Size of the undeformed body about its own frame. */
  private measure(): void {
    const position = this.group.position.clone();
    const quaternion = this.group.quaternion.clone();
    const parent = this.group.parent;
    this.group.removeFromParent();
    this.group.position.set(0, 0, 0);
    this.group.quaternion.identity();
    this.group.updateMatrixWorld(true);
    this.restBox.setFromObject(this.group);
    this.group.position.copy(position);
    this.group.quaternion.copy(quaternion);
    parent?.add(this.group);
  }

  place(motion: Motion): void {
    const b = this.data.index;
    this.group.position.set(motion.position[3 * b], motion.position[3 * b + 1], motion.position[3 * b + 2]);
    this.group.quaternion.set(motion.quaternion[4 * b], motion.quaternion[4 * b + 1], motion.quaternion[4 * b + 2], motion.quaternion[4 * b + 3]);
    if (this.back && this.bending) {
      this.group.updateMatrix();
      (this.bending.uniforms.away.value as Matrix4).multiplyMatrices(this.back, this.group.matrix);
    }
    this.bending?.setFrame(motion.frame, motion.frame + 1 < motion.scene.time.length ? motion.part : 0);
  }

  /** From now on the body swings about where it is. */
  keepStill(): Group {
    this.group.updateMatrix();
    this.back = this.group.matrix.clone().invert();
    this.still = new Group();
    this.still.position.copy(this.group.position);
    this.still.quaternion.copy(this.group.quaternion);
    if (this.lines && this.bending?.stillLines) {
      const lines = new LineSegments(this.lines.geometry, this.bending.stillLines);
      lines.frustumCulled = false;
      this.still.add(lines);
    } else {
      const material = new LineBasicMaterial({ color: STILL_COLOUR, transparent: true, opacity: 0.55 });
      for (const part of this.group.children) {
        const edges = part.getObjectByName('edges');
        if (!(edges instanceof LineSegments)) continue;
        const holder = new Group();
        holder.position.copy(part.position);
        holder.quaternion.copy(part.quaternion);
        holder.scale.copy(part.scale);
        holder.add(new LineSegments(edges.geometry, material));
        this.still.add(holder);
      }
    }
    return this.still;
  }

  /** Colours by displacement (null), a field, or the body's own colour (undefined). */
  colourBy(field: FieldData | null | undefined, range: [number, number], neutral: boolean): void {
    const coloured = field === undefined ? false : field === null ? this.flexible || (this.back !== null && this.mesh !== null) : (this.data.mesh?.fields.includes(field) ?? false);
    this.bending?.colourBy(coloured ? field : undefined, range);
    // A body with a colour of its own keeps it beside a scale.
    if (this.material.vertexColors) this.material.color.copy(WHITE);
    else this.material.color.copy(neutral && !this.data.mesh?.colour ? NEUTRAL : this.colour);
  }

  setSelected(selected: boolean): void {
    this.material.emissive.copy(HIGHLIGHT);
    this.material.emissiveIntensity = selected ? 0.28 : 0;
  }

  /** Glass: a shape that stands for an inertia is nothing that could be seen; a shell would hide what bends. */
  setGhost(on: boolean): void {
    this.material.transparent = on;
    this.material.opacity = on ? 0.3 : 1;
    this.material.depthWrite = !on;
    this.material.needsUpdate = true;
  }

  setEdges(visible: boolean): void {
    this.group.traverse((object) => {
      if (object instanceof LineSegments) object.visible = visible;
    });
  }

  setWire(wire: boolean): void {
    if (this.mesh) this.material.wireframe = wire;
  }

  setTriad(visible: boolean, size: number): void {
    if (visible && !this.triad) {
      this.triad = buildTriad(size);
      this.group.add(this.triad);
    }
    if (this.triad) this.triad.visible = visible;
  }
}

/** Colours of vertices, of a surface whose triangles have several. */
function paint(geometry: BufferGeometry, mesh: MeshData, own: Color, material: MeshPhongMaterial): void {
  const colours = new Float32Array(3 * geometry.getAttribute('position').count);
  const index = geometry.getIndex()!;
  mesh.paints.forEach(({ first, colour }, k) => {
    const end = k + 1 < mesh.paints.length ? mesh.paints[k + 1].first : index.count / 3;
    const value = colour ? new Color(colour) : own;
    for (let i = 3 * first; i < 3 * end; ++i) value.toArray(colours, 3 * index.getX(i));
  });
  geometry.setAttribute('color', new BufferAttribute(colours, 3));
  material.vertexColors = true;
  material.color.copy(WHITE);
}

const corner = new Vector3();

/** Radius about the frame that holds the undeformed body. */
export function radiusOf(body: BodyData): number {
  if (body.bound > 0) return body.bound;
  let radius = 0;
  const vertices = body.mesh?.vertices;
  if (vertices) for (let i = 0; i < vertices.length; i += 3) radius = Math.max(radius, corner.set(vertices[i], vertices[i + 1], vertices[i + 2]).length());
  else if (body.solid) radius = Math.hypot(...body.solid.size) / 2 + Math.hypot(...body.solid.position);
  return radius;
}
