// Shapes of rigid bodies: boxes, ellipsoids, files of other programs, and sticks for bodies of which only points are known.

import { BoxGeometry, EdgesGeometry, Group, LineBasicMaterial, LineSegments, LoadingManager, Mesh, MeshPhongMaterial, SphereGeometry, type Material } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { OBJLoader } from 'three/addons/loaders/OBJLoader.js';
import { STLLoader } from 'three/addons/loaders/STLLoader.js';
import type { BodyData, SolidData } from '../data/scene_data';
import type { Triple } from '../data/page';
import { bar } from './symbols';

// What a file refers to outside itself is not fetched: the page is one file.
const closed = new LoadingManager();
closed.setURLModifier((url) => (/^(data|blob):/.test(url) ? url : 'data:,'));

function dress(group: Group, material: Material, lines: LineBasicMaterial): void {
  const meshes: Mesh[] = [];
  group.traverse((object) => {
    if (object instanceof Mesh) meshes.push(object);
  });
  for (const mesh of meshes) {
    if (!mesh.geometry.getAttribute('normal')) mesh.geometry.computeVertexNormals();
    mesh.material = material;
    const edges = new LineSegments(new EdgesGeometry(mesh.geometry, 35), lines);
    edges.name = 'edges';
    mesh.add(edges);
  }
}

async function loadFile(solid: SolidData): Promise<Group> {
  const bytes = solid.bytes!;
  const group = new Group();
  if (solid.format === 'stl') {
    const geometry = new STLLoader().parse(bytes);
    // Normals in files are often zero.
    geometry.computeVertexNormals();
    group.add(new Mesh(geometry));
  } else if (solid.format === 'obj') group.add(new OBJLoader().parse(new TextDecoder().decode(bytes)));
  else {
    const content = solid.format === 'gltf' ? new TextDecoder().decode(bytes) : bytes;
    const file = await new GLTFLoader(closed).parseAsync(content, '');
    // glTF has y up; a file is placed as it is, so that its axes are those of the body.
    group.add(file.scene);
  }
  return group;
}

/** The shape, at once or (files) a little later; `failed` gets a sentence. */
export function buildSolid(body: BodyData, solid: SolidData, material: MeshPhongMaterial, lines: LineBasicMaterial, ready: () => void, failed: (sentence: string) => void): Group {
  const group = new Group();
  group.position.set(...solid.position);
  group.quaternion.set(...solid.quaternion);
  if (solid.kind === 'file') {
    group.scale.setScalar(solid.scale);
    loadFile(solid)
      .then((shape) => {
        dress(shape, material, lines);
        group.add(shape);
        ready();
      })
      .catch((error: unknown) => failed(`Body "${body.name}": its geometry (${solid.format}) cannot be read: ${error instanceof Error ? error.message : String(error)}`));
    return group;
  }
  const geometry = solid.kind === 'box' ? new BoxGeometry(1, 1, 1) : new SphereGeometry(0.5, 40, 24);
  group.scale.set(...(solid.size.map((x) => Math.max(Math.abs(x), 1e-9)) as Triple));
  group.add(new Mesh(geometry, material));
  if (solid.kind === 'box') {
    const edges = new LineSegments(new EdgesGeometry(geometry), lines);
    edges.name = 'edges';
    group.add(edges);
  }
  return group;
}

/** Bars from the frame to the points of the body. */
export function buildSticks(places: Triple[], radius: number, material: MeshPhongMaterial): Group {
  const group = new Group();
  const ball = new Mesh(new SphereGeometry(1.6 * radius, 20, 14), material);
  group.add(ball);
  for (const place of places) {
    if (Math.hypot(...place) < 2 * radius) continue;
    group.add(bar([0, 0, 0], place, radius, material));
    const end = new Mesh(new SphereGeometry(1.15 * radius, 16, 10), material);
    end.position.set(...place);
    group.add(end);
  }
  return group;
}
