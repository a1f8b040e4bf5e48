// Meshes of simple bodies with mode shapes given by formulas.

export interface Mesh {
  vertices: number[];
  triangles: number[];
}

/** A box along x from 0 to `length`, `n` by `m` cells on its long faces. */
export function beamMesh(length: number, width: number, height: number, n: number, m: number): Mesh {
  const vertices: number[] = [];
  const triangles: number[] = [];
  const face = (corner: number[], u: number[], v: number[], nu: number, nv: number): void => {
    const first = vertices.length / 3;
    for (let i = 0; i <= nu; ++i) {
      for (let k = 0; k <= nv; ++k) for (let c = 0; c < 3; ++c) vertices.push(corner[c] + (u[c] * i) / nu + (v[c] * k) / nv);
    }
    for (let i = 0; i < nu; ++i) {
      for (let k = 0; k < nv; ++k) {
        const a = first + i * (nv + 1) + k;
        const b = a + nv + 1;
        triangles.push(a, b, b + 1, a, b + 1, a + 1);
      }
    }
  };
  const [y, z] = [width / 2, height / 2];
  face([0, -y, z], [length, 0, 0], [0, width, 0], n, m);
  face([0, y, -z], [length, 0, 0], [0, -width, 0], n, m);
  face([0, -y, -z], [length, 0, 0], [0, 0, height], n, m);
  face([0, y, z], [length, 0, 0], [0, 0, -height], n, m);
  face([0, y, -z], [0, -width, 0], [0, 0, height], m, m);
  face([length, -y, -z], [0, width, 0], [0, 0, height], m, m);
  return { vertices, triangles };
}

/** A tube along x with `around` by `along` cells, closed by nothing. */
export function tubeMesh(length: number, radius: number, around: number, along: number): Mesh {
  const vertices: number[] = [];
  const triangles: number[] = [];
  for (let i = 0; i <= along; ++i) {
    for (let k = 0; k < around; ++k) {
      const angle = (2 * Math.PI * k) / around;
      // An arm that is thicker at its ends.
      const r = radius * (1 + 0.35 * (2 * (i / along) - 1) ** 4);
      vertices.push((length * i) / along, r * Math.cos(angle), r * Math.sin(angle));
    }
  }
  for (let i = 0; i < along; ++i) {
    for (let k = 0; k < around; ++k) {
      const a = i * around + k;
      const b = i * around + ((k + 1) % around);
      triangles.push(a, b, a + around, b, b + around, a + around);
    }
  }
  return { vertices, triangles };
}

/** Displacement of mode j of a cantilever of this length at a place: bending in z, in y, torsion, in turn. */
export function modeShape(j: number, length: number, x: number, y: number, z: number): [number, number, number] {
  const s = x / length;
  const order = Math.floor(j / 3) + 1;
  const w = (2 * s) ** 2 / 4 * Math.cos((order - 1) * Math.PI * s);
  const slope = (2 * s / length) * Math.cos((order - 1) * Math.PI * s) - s * s * ((order - 1) * Math.PI / length) * Math.sin((order - 1) * Math.PI * s);
  if (j % 3 === 0) return [-z * slope, 0, w];
  if (j % 3 === 1) return [-y * slope, w, 0];
  const turn = 3 * s * Math.cos((order - 1) * Math.PI * s);
  return [0, -z * turn, y * turn];
}

export function displacements(mesh: Mesh, length: number, modes: number): number[] {
  const values: number[] = [];
  for (let v = 0; v < mesh.vertices.length; v += 3) {
    for (let j = 0; j < modes; ++j) values.push(...modeShape(j, length, mesh.vertices[v], mesh.vertices[v + 1], mesh.vertices[v + 2]));
  }
  return values;
}

/** A tetrahedron with its right corner at a place. */
export function tetrahedron(size: number, [x, y, z]: [number, number, number]): Mesh {
  return { vertices: [x, y, z, x + size, y, z, x, y + size, z, x, y, z + size], triangles: [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3] };
}
