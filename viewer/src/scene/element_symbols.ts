// Symbols of elements that act at one place, about an axis: z.

import { BoxGeometry, type BufferGeometry, CylinderGeometry, Group, LatheGeometry, Mesh, SphereGeometry, Vector2 } from 'three';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';
import { DAMPER_COLOUR, GUIDE_COLOUR, RIM_COLOUR, SPRING_COLOUR } from './palette';
import { buildJoint, plain } from './symbols';

/** A tube about z. */
function tube(inner: number, outer: number, length: number): BufferGeometry {
  const half = length / 2;
  const profile = [new Vector2(inner, -half), new Vector2(outer, -half), new Vector2(outer, half), new Vector2(inner, half), new Vector2(inner, -half)];
  // Corners of a profile would be shaded as round.
  const sides = profile.slice(1).map((to, k) => new LatheGeometry([profile[k], to], 40));
  return mergeGeometries(sides).rotateX(Math.PI / 2);
}

/** Two rings and the balls between them; `radius` is that of the shaft. */
function bearing(size: number, radius: number): Group {
  const shaft = radius > 0 ? radius : 1.2 * size;
  const ball = Math.max(0.22 * shaft, 0.3 * size);
  const width = 2.4 * ball;
  const middle = shaft + 0.35 * ball + ball;
  const count = Math.max(7, Math.floor((2 * Math.PI * middle) / (2.6 * ball)));
  const balls = Array.from({ length: count }, (_, k) => {
    const angle = (2 * Math.PI * k) / count;
    return new SphereGeometry(ball, 14, 10).translate(middle * Math.cos(angle), middle * Math.sin(angle), 0);
  });
  const rings = mergeGeometries([tube(shaft, shaft + 0.6 * ball, width), tube(middle + 0.75 * ball, middle + 1.35 * ball, width)]);
  return new Group().add(new Mesh(rings, plain(DAMPER_COLOUR)), new Mesh(mergeGeometries(balls), plain(RIM_COLOUR)));
}

/** Rubber between two tubes; the inner one is longer. */
function bushing(size: number): Group {
  return new Group().add(
    new Mesh(mergeGeometries([tube(0.35 * size, 0.6 * size, 3.4 * size), tube(1.45 * size, 1.65 * size, 2.4 * size)]), plain(DAMPER_COLOUR)),
    new Mesh(tube(0.6 * size, 1.45 * size, 2.2 * size), plain(SPRING_COLOUR)),
  );
}

/** A toothed wheel. */
function coupling(size: number): Group {
  const teeth = 12;
  const parts: BufferGeometry[] = [tube(0.4 * size, 1.5 * size, 0.7 * size)];
  for (let k = 0; k < teeth; ++k) parts.push(new BoxGeometry(0.5 * size, 0.36 * size, 0.7 * size).translate(1.65 * size, 0, 0).rotateZ((2 * Math.PI * k) / teeth));
  parts.push(new CylinderGeometry(0.3 * size, 0.3 * size, 2.2 * size, 20).rotateX(Math.PI / 2));
  return new Group().add(new Mesh(mergeGeometries(parts), plain(GUIDE_COLOUR)));
}

/** By the name that the program gives a picture; `size` is about half their width. */
const SYMBOLS: Record<string, (size: number, radius: number) => Group> = {
  ring: (size) => buildJoint(1, 1, size, plain(SPRING_COLOUR)),
  bearing,
  bushing,
  coupling,
};

export function isPlaceSymbol(picture: string): boolean {
  return Object.hasOwn(SYMBOLS, picture);
}

export function buildPlaceSymbol(picture: string, size: number, radius: number): Group {
  const group = SYMBOLS[picture](size, radius);
  group.name = picture;
  return group;
}
