// The runs of a parameter study, checked.

import { PageBuffer, PageError } from './buffer';
import type { StudyJson } from './page';

export interface Variable {
  name: string;
  values: string[];
  /** Null if any value is a word. */
  numbers: number[] | null;
  /** Values, each once: ascending numbers, words as they first occur. */
  levels: string[];
}

export interface Measure {
  name: string;
  unit: string;
  /** Of each run; not a number where it has none. */
  values: Float64Array;
}

export interface RunCurve {
  run: number;
  time: Float64Array;
  values: Float32Array;
}

export interface StudyChannel {
  name: string;
  unit: string;
  curves: RunCurve[];
}

export interface StudyData {
  runs: number;
  variables: Variable[];
  measures: Measure[];
  states: string[];
  messages: string[];
  channels: StudyChannel[];
  runsWithoutCurves: number;
  ranking: { measure: number; largest: boolean } | null;
  pages: { run: number; address: string }[];
}

function variableOf(name: string, values: string[]): Variable {
  const numbers = values.map((text) => (text.trim() === '' ? NaN : Number(text)));
  const known = numbers.every(Number.isFinite);
  const levels = [...new Set(values)];
  if (known) levels.sort((a, b) => Number(a) - Number(b));
  return { name, values, numbers: known ? numbers : null, levels };
}

function channelsOf(json: NonNullable<StudyJson['curves']>, runs: number, buffer: PageBuffer): StudyChannel[] {
  const channels: StudyChannel[] = json.channels.map(({ name, unit }) => ({ name: String(name), unit: String(unit ?? ''), curves: [] }));
  for (const { run, channels: which, time, values } of json.runs) {
    const what = `Curves of run ${run + 1}`;
    if (!(Number.isInteger(run) && run >= 0 && run < runs)) throw new PageError(`${what}: the study has no such run.`);
    const times = Float64Array.from(buffer.read(time, what, ['f64'], [null]));
    const table = buffer.read(values, what, ['f32'], [which.length, times.length]) as Float32Array;
    which.forEach((c, k) => channels[c]?.curves.push({ run, time: times, values: table.slice(k * times.length, (k + 1) * times.length) }));
  }
  return channels;
}

/** Throws PageError. */
export function readStudy(json: StudyJson, buffer: PageBuffer): StudyData {
  const runs = json.states.length;
  const variables = json.variables.map(({ name, values }) => {
    if (values.length !== runs) throw new PageError(`"${name}" has ${values.length} values of ${runs} runs.`);
    return variableOf(String(name), values.map(String));
  });
  const measures = json.measures.map(({ name, unit, values }) => ({ name: String(name), unit: String(unit ?? ''), values: Float64Array.from(buffer.read(values, `Figure "${name}"`, ['f64'], [runs])) }));
  const ranked = measures.findIndex(({ name }) => name === json.ranking?.measure);
  return {
    runs,
    variables,
    measures,
    states: json.states.map(String),
    messages: json.states.map((_, k) => String(json.messages?.[k] ?? '')),
    channels: json.curves ? channelsOf(json.curves, runs, buffer) : [],
    runsWithoutCurves: json.runs_without_curves ?? 0,
    ranking: json.ranking && ranked >= 0 ? { measure: ranked, largest: json.ranking.largest === true } : null,
    pages: json.pages ? Object.values(json.pages).map(({ run, address }) => ({ run, address: String(address) })) : [],
  };
}

/** Completed runs that have the figure, the best first. */
export function rankedRuns(study: StudyData, measure: number, largest: boolean): number[] {
  const values = study.measures[measure]?.values ?? [];
  const runs = study.states.flatMap((state, k) => (state === 'completed' && Number.isFinite(values[k]) ? [k] : []));
  return runs.sort((a, b) => (largest ? values[b] - values[a] : values[a] - values[b]) || a - b);
}

/** Most classes in which the numbers of one variable are put together. */
const CLASSES = 8;

export interface Effect {
  /** A value of the variable, or the mean of a class of its values. */
  level: string;
  at: number;
  mean: number;
  least: number;
  most: number;
  runs: number;
}

/** Mean of a figure over the runs that share a value: what a variable does by itself, the others as they are in the study. */
export function mainEffect(variable: Variable, values: ArrayLike<number>, runs: number[]): Effect[] {
  let classes: number[][];
  if (variable.numbers && variable.levels.length > CLASSES) {
    const { numbers } = variable;
    const sorted = [...runs].sort((a, b) => numbers[a] - numbers[b]);
    classes = Array.from({ length: CLASSES }, (_, k) => sorted.slice(Math.round((k * sorted.length) / CLASSES), Math.round(((k + 1) * sorted.length) / CLASSES)));
  } else classes = variable.levels.map((level) => runs.filter((run) => variable.values[run] === level));
  return classes.flatMap((members): Effect[] => {
    if (members.length === 0) return [];
    const found = members.map((run) => values[run]);
    const at = variable.numbers ? members.reduce((sum, run) => sum + variable.numbers![run], 0) / members.length : variable.levels.indexOf(variable.values[members[0]]);
    return [{ level: variable.values[members[0]], at, mean: found.reduce((a, b) => a + b, 0) / found.length, least: Math.min(...found), most: Math.max(...found), runs: found.length }];
  });
}

/** Numbers at equal ratios rather than at equal distances. */
export function isLogarithmic(variable: Variable): boolean {
  if (!variable.numbers || variable.levels.length < 3) return false;
  const levels = variable.levels.map(Number);
  return levels[0] > 0 && levels[levels.length - 1] / levels[0] >= 50;
}
