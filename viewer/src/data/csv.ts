// results.csv of another run: first column `time [s]`, then names of channels with their units, lines beginning with # are comments. Units may be left
// out.

export interface CsvTable {
  time: Float64Array;
  columns: Map<string, Float64Array>;
  /** Of the columns that name one. */
  units: Map<string, string>;
  /** Lines that are not rows of numbers. */
  skipped: number;
}

/** The cells of one line; quoted cells may hold commas, and "" is a quote. */
function splitLine(line: string): string[] {
  if (!line.includes('"')) return line.split(',');
  const cells: string[] = [];
  let cell = '';
  let quoted = false;
  for (let i = 0; i < line.length; ++i) {
    const c = line[i];
    if (quoted) {
      if (c !== '"') cell += c;
      else if (line[i + 1] === '"') {
        cell += '"';
        ++i;
      } else quoted = false;
    } else if (c === '"') quoted = true;
    else if (c === ',') {
      cells.push(cell);
      cell = '';
    } else cell += c;
  }
  cells.push(cell);
  return cells;
}

/** "chassis.z [m]" is the channel chassis.z in m. */
function nameAndUnit(title: string): [string, string] {
  const found = /^(.*\S)\s*\[([^[\]]*)\]$/.exec(title);
  return found ? [found[1], found[2].trim()] : [title, ''];
}

/** Throws an Error with a sentence if the text is not a table over time. */
export function parseCsv(text: string): CsvTable {
  const lines = text.split(/\r\n|\n|\r/).filter((line) => line.trim() !== '' && !line.trimStart().startsWith('#'));
  if (lines.length === 0) throw new Error('the file has no rows');
  const titles = splitLine(lines[0].replace(/^\ufeff/, '')).map((title) => nameAndUnit(title.trim()));
  const names = titles.map(([name]) => name);
  if (names[0] !== 'time') throw new Error(`its first column is "${names[0].slice(0, 40)}", expected "time"`);
  if (!['', 's'].includes(titles[0][1])) throw new Error(`its times are in "${titles[0][1].slice(0, 40)}", expected s`);
  const rows: number[][] = [];
  let skipped = 0;
  let last = -Infinity;
  for (const line of lines.slice(1)) {
    const cells = splitLine(line);
    const row = cells.map((cell) => (cell.trim() === '' ? NaN : Number(cell)));
    if (row.length !== names.length || !Number.isFinite(row[0]) || row[0] < last) {
      ++skipped;
      continue;
    }
    last = row[0];
    rows.push(row);
  }
  if (rows.length === 0) throw new Error('the file has a header but no rows of numbers');
  const column = (k: number): Float64Array => Float64Array.from(rows, (row) => row[k]);
  const columns = new Map<string, Float64Array>();
  const units = new Map<string, string>();
  titles.forEach(([name, unit], k) => {
    if (k === 0 || name === '') return;
    columns.set(name, column(k));
    if (unit !== '') units.set(name, unit);
  });
  return { time: column(0), columns, units, skipped };
}
