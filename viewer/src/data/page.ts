// The page's data as the program writes them; viewer/README.md describes each key.

export type ViewType = 'f16' | 'f32' | 'f64' | 'u16' | 'u32';

/** An array in the buffer: row-major, `offset` in bytes. */
export interface View {
  type: ViewType;
  offset: number;
  shape: number[];
}

export type Triple = [number, number, number];
export type Quadruple = [number, number, number, number];
export type PageKind = 'run' | 'check' | 'reduce' | 'compare' | 'modes' | 'sweep';

export interface ChannelJson {
  name: string;
  label?: string | null;
  unit?: string | null;
  body?: string | null;
  kind?: string | null;
  data: View;
  offset?: number | null;
  constant?: boolean | null;
  noise?: boolean | null;
  group?: string | null;
  /** What the value is to stay below: drawn as a line where it is near. */
  limit?: number | null;
  other?: View | null;
  other_offset?: number | null;
  difference?: { max?: number | null; rms?: number | null; tolerance?: number | null; beyond?: boolean | null } | null;
}

export interface CurvesJson {
  time: View;
  other_time?: View | null;
  /** Names of the two runs of a comparison. */
  names?: [string, string] | null;
  channels: ChannelJson[];
}

export interface TableJson {
  heading: string;
  columns?: string[] | null;
  rows: (string | number)[][];
  note?: string | null;
}

export interface PlacedJson {
  position?: Triple | null;
  quaternion?: Quadruple | null;
}

export interface FieldJson {
  name: string;
  unit?: string | null;
  /** Linear in the amplitudes: f16 [V, m]. */
  modes?: View | null;
  /** Values at the amplitudes zero: f16 [V]; with `modes` only. */
  base?: View | null;
  /** Or given at each frame: f16 [F, V]. */
  history?: View | null;
}

/** Stress of the vertices of a mesh: `factor` [Pa] times halves. */
export interface StressJson {
  factor: number;
  /** xx, yy, zz, xy, yz, zx per amplitude: f16 [V, m, 6]. */
  modes: View;
  /** Of the load coefficients, which stand behind the amplitudes from `first_load` on: f16 [V, n, 6]. */
  loads?: View | null;
  first_load?: number;
  /** Vertices that are not to be trusted: u16 or u32. */
  doubtful?: View | null;
  /** Largest von Mises stress over the run: f32 [V] [Pa], and when: f32 [V] [s]. */
  envelope?: View | null;
  when?: View | null;
  /** True: of all recorded instants, which the frames are. */
  all_instants?: boolean | null;
  /** True: several places meet at some vertices (sides of shells, materials). */
  several?: boolean | null;
}

export interface MeshJson {
  kind: 'mesh';
  vertices: View;
  triangles: View;
  normals?: View | null;
  displacements?: View | null;
  nodes?: View | null;
  generated?: boolean | null;
  /** "#rrggbb" */
  color?: string | null;
  /** Where colours differ: the first triangle of each, and "#rrggbb" or null. */
  paints?: [number, string | null][] | null;
}

export type ShapeJson =
  | MeshJson
  | ({ kind: 'box' | 'cylinder' | 'ellipsoid'; size: Triple } & PlacedJson);

export interface ModesJson {
  first: number;
  count: number;
  frequencies?: (number | null)[] | null;
  names?: string[] | null;
}

export interface BodyJson {
  name: string;
  mass?: number | null;
  facts?: [string, string][] | null;
  modes?: ModesJson | null;
  shape?: ShapeJson | null;
  bound?: number | null;
  size?: number | null;
  fields?: FieldJson[] | null;
  stress?: StressJson | null;
  /** Numbers that its stress has, too many for the page. */
  stress_left_out?: number | null;
  /** False: its states were not recorded. */
  recorded?: boolean | null;
  spiders?: { point: number; vertices: View }[] | null;
}

export interface PointJson {
  name?: string | null;
  body: number;
  p: Triple;
  modes?: Triple[] | null;
}

export interface JointJson {
  name: string;
  type: string;
  /** What it leaves free. */
  turns: number;
  slides: number;
  a: number;
  b: number;
  axis?: Triple | null;
  axes?: Quadruple | null;
  cut?: boolean | null;
  /** Its coordinates and their rates. */
  values?: ValueJson[] | null;
}

/** A number at each frame: a column of the efforts. */
export interface ValueJson {
  name: string;
  unit?: string | null;
  column: number;
}

/** Columns of varying numbers first, then the constants. */
export interface EffortsJson {
  /** f32 [F, C] */
  data?: View | null;
  constants?: (number | null)[] | null;
}

export type PictureSymbol = 'none' | 'spring' | 'ring' | 'wheel' | 'force' | 'torque' | 'bearing' | 'bushing' | 'coupling';

export interface ForceJson {
  name: string;
  type: string;
  /** How it is drawn. */
  picture: PictureSymbol;
  a: number;
  b: number;
  axis?: Triple | null;
  /** Whether the axis turns with the body of a or stands in the world. */
  follows?: boolean | null;
  radius?: number | null;
  width?: number | null;
  /** What it exerts at a point: columns of x, y, z of its force [N] and of its torque about the point [N m], in the world. */
  wrench?: { at: number; columns: number[] } | null;
  /** Its results. */
  values?: ValueJson[] | null;
}

/** A name and its part of an energy. */
export type ShareJson = [string, number];

export interface VibrationJson {
  /** Null: a rigid motion. */
  number?: number | null;
  kind: string;
  frequency: number;
  undamped: number;
  damping: number;
  moves?: ShareJson[] | null;
  held?: ShareJson[] | null;
}

export interface VibrationsJson {
  list: VibrationJson[];
  /** f32 [n, 2, bodies, 6]: real and imaginary displacement and rotation vector, in the world. */
  places: View;
  /** f32 [n, 2, amplitudes] */
  amplitudes?: View | null;
}

export interface SceneJson {
  frames: { time: View; pose: View; amplitudes?: View | null } | null;
  origin?: Triple | null;
  up?: Triple | null;
  bodies: BodyJson[];
  points?: PointJson[] | null;
  joints?: JointJson[] | null;
  forces?: ForceJson[] | null;
  rods?: { name: string; a: number; b: number }[] | null;
  /** Lines on the body of a point: f32 [n, 3] from the point, in its frame. */
  strokes?: { name: string; a: number; points: View }[] | null;
  roads?: { name: string; profile: View; width: [number, number] }[] | null;
  efforts?: EffortsJson | null;
  gravity?: Triple | null;
  vibrations?: VibrationsJson | null;
}

/** A parameter study: all lists by run, in the order of the plan. */
export interface StudyJson {
  variables: { name: string; values: string[] }[];
  /** "completed" or "failed", and why. */
  states: string[];
  messages?: string[] | null;
  /** f64 [runs], not a number where a run has no such figure. */
  measures: { name: string; unit?: string | null; values: View }[];
  /** Of some runs: time f64 [n], values f32 [channels of the run, n]. */
  curves?: { channels: { name: string; unit?: string | null }[]; runs: { run: number; channels: number[]; time: View; values: View }[] } | null;
  runs_without_curves?: number | null;
  ranking?: { measure: string; largest?: boolean | null } | null;
  /** Pages of the best and the worst run, by addresses from this page. */
  pages?: Record<string, { run: number; address: string }> | null;
}

export interface PageJson {
  schema: number;
  kind: PageKind;
  title?: string | null;
  program?: string | null;
  compression?: string | null;
  status?: { state?: string | null; sentences?: string[] | null; warnings?: string[] | null } | null;
  facts?: TableJson[] | null;
  tables?: TableJson[] | null;
  curves?: CurvesJson | null;
  /** Channels have times of their own if `time` is given; notes are sentences by group. */
  trust?: { time?: View | null; channels?: ChannelJson[] | null; rows?: string[][] | null; tables?: TableJson[] | null; notes?: Record<string, string> | null } | null;
  /** Step times in ms. */
  speed?: { rows?: string[][] | null; step_times?: { edges: number[]; counts: number[]; median?: number | null; percent_99?: number | null } | null } | null;
  scene?: SceneJson | null;
  study?: StudyJson | null;
}
