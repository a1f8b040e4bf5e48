// results.csv of another run: first column `time`, header names are those of channels, lines beginning with # are comments.

export interface CsvTable {
  time: Float64Array;
  columns: Map<string, Float64Array>;
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

/** Throws an Error with a sentence if the text is not a table over time. */
export function parseCsv(text: string): CsvTable {
  const lines = text.split(/\r\n|\n|\r/).filter((line) => line.trim() !== '' && !line.trimStart().startsWith('#'));
  if (lines.length === 0) throw new Error('the file has no rows');
  const names = splitLine(lines[0].replace(/^\ufeff/, '')).map((name) => name.trim());
  if (names[0] !== 'time') throw new Error(`its first column is "${names[0].slice(0, 40)}", expected "time"`);
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
  names.forEach((name, k) => {
    if (k > 0 && name !== '') columns.set(name, column(k));
  });
  return { time: column(0), columns, skipped };
}
