// Time of the page: one cursor that the view and all curves share.

export const SPEEDS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];

type Listener = () => void;

export class Player {
  time: number;
  playing = false;
  loop = true;
  speed = 1;
  /** Seconds of the record that have been played so far, begun again or not. */
  played = 0;
  readonly start: number;
  readonly end: number;
  /** Instants that single steps go to. */
  readonly instants: ArrayLike<number>;
  private readonly timeListeners = new Set<Listener>();
  private readonly stateListeners = new Set<Listener>();

  constructor(instants: ArrayLike<number>) {
    this.instants = instants;
    this.start = instants.length > 0 ? instants[0] : 0;
    this.end = instants.length > 0 ? instants[instants.length - 1] : 0;
    this.time = this.start;
  }

  get moves(): boolean {
    return this.end > this.start;
  }

  onTime(listener: Listener): void {
    this.timeListeners.add(listener);
  }

  onState(listener: Listener): void {
    this.stateListeners.add(listener);
  }

  set(time: number): void {
    if (!Number.isFinite(time)) return;
    const next = Math.min(this.end, Math.max(this.start, time));
    if (next === this.time) return;
    this.time = next;
    for (const listener of this.timeListeners) listener();
  }

  /** Goes on by `seconds` of the clock; stops or begins again at the end. */
  advance(seconds: number): void {
    if (!this.playing) return;
    this.played += seconds * this.speed;
    const next = this.time + seconds * this.speed;
    if (next < this.end) this.set(next);
    else if (this.loop && this.moves) this.set(this.start + ((next - this.start) % (this.end - this.start)));
    else {
      this.set(this.end);
      this.pause();
    }
  }

  play(): void {
    if (!this.moves || this.playing) return;
    if (this.time >= this.end) this.set(this.start);
    this.playing = true;
    this.changed();
  }

  pause(): void {
    if (!this.playing) return;
    this.playing = false;
    this.changed();
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  setLoop(loop: boolean): void {
    this.loop = loop;
    this.changed();
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.changed();
  }

  /** The next speed of the list, up (+1) or down (-1). */
  changeSpeed(direction: number): void {
    const nearest = SPEEDS.reduce((best, speed, k) => (Math.abs(Math.log(speed / this.speed)) < Math.abs(Math.log(SPEEDS[best] / this.speed)) ? k : best), 0);
    this.setSpeed(SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, nearest + direction))]);
  }

  /** To a neighbouring instant of the record, `count` of them forward or back. */
  step(count: number): void {
    this.pause();
    const n = this.instants.length;
    if (n === 0) return;
    let low = 0;
    let high = n;
    const slack = 1e-9 * (this.end - this.start);
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.instants[middle] < this.time - slack) low = middle + 1;
      else high = middle;
    }
    const exact = low < n && Math.abs(this.instants[low] - this.time) <= slack;
    const target = count > 0 ? low + count - (exact ? 0 : 1) : low + count;
    this.set(this.instants[Math.min(n - 1, Math.max(0, target))]);
  }

  private changed(): void {
    for (const listener of this.stateListeners) listener();
  }
}
