// What all plots share: the zoomed range of time, the pointer, the time of the view, the curves of a second run.

import type { CsvTable } from '../data/csv';
import type { Player } from '../motion/player';

export interface HubMember {
  rangeChanged(): void;
  hoverChanged(): void;
  timeChanged(): void;
  dataChanged(): void;
}

export class Hub {
  range: [number, number] | null = null;
  hover: number | null = null;
  overlay: CsvTable | null = null;
  showDifference = false;
  player: Player | null = null;
  private readonly members = new Set<HubMember>();
  private readonly listeners: (() => void)[] = [];
  private texts = 0;

  add(member: HubMember): void {
    this.members.add(member);
  }

  remove(member: HubMember): void {
    this.members.delete(member);
  }

  onRange(listener: () => void): void {
    this.listeners.push(listener);
  }

  setRange(range: [number, number] | null): void {
    if (range && this.range && range[0] === this.range[0] && range[1] === this.range[1]) return;
    if (!range && !this.range) return;
    this.range = range;
    for (const member of this.members) member.rangeChanged();
    for (const listener of this.listeners) listener();
  }

  setHover(time: number | null): void {
    if (time === this.hover) return;
    this.hover = time;
    for (const member of this.members) member.hoverChanged();
  }

  setOverlay(table: CsvTable | null): void {
    this.overlay = table;
    for (const member of this.members) member.dataChanged();
  }

  setDifference(on: boolean): void {
    this.showDifference = on;
    for (const member of this.members) member.dataChanged();
  }

  seek(time: number): void {
    this.player?.pause();
    this.player?.set(time);
  }

  /** Lines move at each frame, values as text ten times a second. */
  get textsDue(): boolean {
    return this.texts === 0;
  }

  tellTime(): void {
    const now = performance.now();
    const due = !this.player?.playing || now - this.lastTexts > 100;
    this.texts = due ? 0 : 1;
    if (due) this.lastTexts = now;
    for (const member of this.members) member.timeChanged();
  }

  private lastTexts = 0;

  redraw(): void {
    for (const member of this.members) member.dataChanged();
  }
}
