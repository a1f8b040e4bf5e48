// The section of the 3-D view: the picture, its tools, the player, the panel beside it.

import type { Channel } from '../data/channels';
import type { SceneData } from '../data/scene_data';
import { Player } from '../motion/player';
import type { Part } from '../scene/connections';
import { keepFree } from '../scene/labels';
import { Stage, type ViewName } from '../scene/stage';
import { ArrowKey } from './arrow_key';
import { BodyList } from './body_list';
import { Colours } from './colours';
import { Display } from './display';
import { button, h } from './dom';
import { buildGizmo } from './gizmo';
import { HotSpotList } from './hot_spots';
import type { Hub } from './hub';
import { Legend } from './legend';
import { ModeList, SWING } from './modes';
import { PlayerBar } from './player_bar';
import { saveScreenshot, takePicture } from './screenshot';
import { Selection } from './selection';
import { isDark, onTheme } from './theme';
import { VibrationList } from './vibrations';

const VIEWS: [ViewName, string][] = [
  ['iso', 'Iso'],
  ['front', 'Front'],
  ['side', 'Side'],
  ['top', 'Top'],
];

function instants(scene: SceneData): ArrayLike<number> {
  if (scene.kind === 'reduce' || scene.vibrations.length > 0) return Array.from({ length: 49 }, (_, k) => (SWING * k) / 48);
  return scene.time.length > 0 ? scene.time : [0];
}

export class ViewSection {
  readonly element: HTMLElement;
  readonly stage: Stage;
  readonly player: Player;
  readonly display: Display;
  readonly bodies: BodyList;
  readonly modes: ModeList | VibrationList | null = null;
  private readonly caption = h('div', { class: 'view-caption', 'aria-live': 'polite' });
  readonly legend = new Legend();
  private readonly arrowKey: ArrowKey;
  readonly hotSpots: HotSpotList;
  private readonly selection: Selection;
  private readonly bar: PlayerBar;
  private readonly frame: HTMLElement;
  private readonly tabs: { button: HTMLButtonElement; panel: HTMLElement }[] = [];
  private readonly title: string;
  private readonly goButton = button('only', 'Go to what is chosen (F)', () => this.goToChosen(), { hidden: true });
  /** Whom the camera followed before it went to a body. */
  private followedBefore: number | null = null;
  private readonly paper = h('canvas', { class: 'paper-picture', 'aria-hidden': 'true' });
  private readonly scriptTimes = new Float32Array(120);
  private scriptCount = 0;
  private before = 0;
  private frames = 0;
  private since = 0;
  private playedBefore = 0;
  rate = 0;

  constructor(scene: SceneData, hub: Hub, channels: Channel[], title: string) {
    this.title = title;
    this.stage = new Stage(scene);
    this.player = new Player(instants(scene));
    hub.player = this.player;
    this.player.onTime(() => hub.tellTime());
    const colours = new Colours(scene, {
      motion: this.stage.motion,
      visible: (body) => this.stage.bodies[body].group.visible,
      chosen: () => this.stage.selected?.body ?? -1,
    });
    if (scene.kind === 'reduce') {
      colours.setRange(null, ModeList.range(scene));
      this.modes = new ModeList(this.stage, this.player);
    } else if (scene.vibrations.length > 0) {
      this.modes = new VibrationList(this.stage, this.player, (text) => (this.caption.textContent = text));
    }
    this.stage.setTheme(isDark());
    onTheme((dark) => this.stage.setTheme(dark));
    this.display = new Display(this.stage, colours, this.legend);
    if (this.modes instanceof ModeList) {
      this.modes.onChoice = (body, mode, amplitude) => {
        colours.setMode(body, mode, amplitude);
        this.display.apply();
      };
      this.modes.choose(this.modes.chosen);
    }
    this.bodies = new BodyList(
      this.stage,
      (body) => this.choose(body, null, true),
      (body) => this.goTo(body),
    );
    for (const body of scene.bodies) if (!body.recorded) this.bodies.set(body.index, false);
    this.selection = new Selection(this.stage, hub, colours.largest, channels);
    this.arrowKey = new ArrowKey(this.stage);
    this.hotSpots = new HotSpotList(this.stage, this.player, (spot) => {
      this.bodies.set(spot.body, true);
      if (!colours.isStress(this.display.shownField)) this.display.setField('Von Mises stress');
      this.choose(spot.body, spot.vertex, false);
    });
    this.bar = new PlayerBar(this.player, this.modes);
    this.stage.canvas.className = 'canvas';
    this.stage.canvas.tabIndex = 0;
    this.stage.canvas.setAttribute('aria-label', 'The model in three dimensions. Drag to turn, wheel to come nearer, right button to move.');
    const tools = h(
      'div',
      { class: 'view-tools no-print' },
      h('div', { class: 'segmented', role: 'group', 'aria-label': 'Standard views' }, ...VIEWS.map(([name, label], k) => h('button', { type: 'button', title: `${label} view (${k + 1})`, onclick: () => this.stage.standard(name) }, label))),
      this.goButton,
      button('fit', 'Fit (Shift+F)', () => this.fit()),
      button('camera', 'Save a picture', () => this.screenshot()),
      button('full', 'Full screen', () => this.fullScreen()),
    );
    this.frame = h('div', { class: 'frame' }, this.stage.canvas, this.paper, tools, buildGizmo(this.stage), this.arrowKey.element, this.legend.element, this.stage.rest ? this.caption : null);
    const side = this.buildSide();
    this.element = h('section', { id: 'view', class: 'card view', 'aria-label': '3-D view' }, h('h2', { class: 'unseen' }, '3-D view'), h('div', { class: 'view-main' }, this.frame, this.player.moves ? this.bar.element : null), side);
    this.listenToPointer();
    this.player.onTime(() => {
      this.stage.go(this.player.time);
      this.display.keepUp();
    });
    new ResizeObserver(() => this.resize()).observe(this.frame);
    new ResizeObserver(() => this.keepNamesFree()).observe(this.legend.element);
    window.addEventListener('beforeprint', () => {
      // What WebGL has drawn may not reach the paper at its new size: a copy does.
      this.stage.draw(true);
      const { width, height } = this.stage.canvas;
      Object.assign(this.paper, { width, height }).getContext('2d')!.drawImage(this.stage.canvas, 0, 0);
      // The bar of its scale has the size of the paper.
      this.resize();
    });
  }

  /** After the section has its place on the page. */
  start(): void {
    this.keepNamesFree();
    this.stage.resize(this.frame.clientWidth, this.frame.clientHeight);
    this.stage.standard('iso');
    if (this.modes && !window.matchMedia('(prefers-reduced-motion: reduce)').matches) this.player.play();
    const tick = (now: number): void => {
      this.tick(now);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame((now) => {
      tick(now);
      performance.mark('first picture');
    });
  }

  choose(body: number, vertex: number | null, open: boolean): void {
    this.stage.select(body, vertex);
    this.bodies.choose(body);
    this.selection.show(body, vertex);
    this.goButton.hidden = body < 0;
    if (open && body >= 0) this.openTab(this.tabs.length - 1);
  }

  choosePart(part: Part): void {
    this.stage.selectPart(part);
    this.bodies.choose(-1);
    this.selection.showPart(part);
    this.openTab(this.tabs.length - 1);
  }

  /** The camera comes to a body and goes with it. */
  goTo(body: number): void {
    const { stage } = this;
    if (!stage.bodies[body]) return;
    if (stage.scene.time.length > 1) {
      this.followedBefore ??= stage.follow;
      this.display.setFollow(body);
    }
    stage.goTo(body);
  }

  goToChosen(): void {
    const chosen = this.stage.selected?.body ?? -1;
    if (chosen >= 0) this.goTo(chosen);
    else this.fit();
  }

  /** Back from a body, to the whole motion. */
  fit(): void {
    if (this.followedBefore !== null) this.display.setFollow(this.followedBefore);
    this.followedBefore = null;
    this.stage.fit();
  }

  screenshot(): void {
    this.stage.draw(true);
    void saveScreenshot(this.picture(), `${this.title}-${this.stage.rest ? this.caption.textContent : `${this.player.time.toFixed(3)}s`}.png`);
  }

  /** The picture with its legend, as it would be saved. */
  picture(): HTMLCanvasElement {
    this.stage.draw(true);
    return takePicture(this.stage.canvas, this.legend, `${this.title}${this.stage.rest ? `, ${this.caption.textContent}` : ''}${this.player.moves && !this.modes ? `, ${this.player.time.toFixed(3)} s` : ''}${this.arrowKey.text ? `, ${this.arrowKey.text}` : ''}`);
  }

  /** Median script time of the last pictures, milliseconds: places, uniforms and the calls that draw. */
  scriptTime(): number {
    const n = Math.min(this.scriptCount, this.scriptTimes.length);
    return n > 0 ? this.scriptTimes.slice(0, n).sort()[n >> 1] : 0;
  }

  /** Pictures since the last reset. */
  get pictures(): number {
    return this.scriptCount;
  }

  resetScriptTime(): void {
    this.scriptCount = 0;
  }

  private tick(now: number): void {
    const seconds = this.before > 0 ? Math.min(0.25, (now - this.before) / 1000) : 0;
    this.before = now;
    const begin = performance.now();
    this.player.advance(seconds);
    this.display.keepUp();
    if (this.stage.draw()) {
      this.scriptTimes[this.scriptCount++ % this.scriptTimes.length] = performance.now() - begin;
      ++this.frames;
    }
    if (now - this.since > 500) {
      this.rate = (1000 * this.frames) / (now - this.since);
      this.bar.showRate(this.rate, (1000 * (this.player.played - this.playedBefore)) / (now - this.since));
      this.playedBefore = this.player.played;
      this.frames = 0;
      this.since = now;
    }
  }

  /** A canvas of another size is empty until it is drawn. */
  private resize(): void {
    this.keepNamesFree();
    if (this.stage.resize(this.frame.clientWidth, this.frame.clientHeight)) this.stage.draw(true);
  }

  /** Names in the picture stand beside its tools, its scale and its axes. */
  private keepNamesFree(): void {
    const frame = this.frame.getBoundingClientRect();
    const boxes = [...this.frame.children]
      .filter((child) => child !== this.stage.canvas && child !== this.paper)
      .map((child) => child.getBoundingClientRect())
      .filter((box) => box.width > 0)
      .map((box) => ({ left: box.left - frame.left, right: box.right - frame.left, top: box.top - frame.top, bottom: box.bottom - frame.top }));
    keepFree(boxes, frame.width, frame.height);
  }

  private fullScreen(): void {
    if (document.fullscreenElement) void document.exitFullscreen();
    else void this.element.requestFullscreen?.();
  }

  private buildSide(): HTMLElement {
    const panels: [string, HTMLElement][] = [];
    if (this.modes && this.modes.count > 0) panels.push(['Modes', this.modes.element]);
    panels.push(['Display', this.display.element], ['Bodies', this.bodies.element]);
    if (this.hotSpots.spots.length > 0) panels.push(['Hot spots', this.hotSpots.element]);
    panels.push(['Selection', this.selection.element]);
    const list = h('div', { class: 'tabs', role: 'tablist' });
    const side = h('div', { class: 'side no-print' }, list);
    panels.forEach(([label, content], k) => {
      const panel = h('div', { class: 'panel', role: 'tabpanel', id: `panel-${k}`, 'aria-labelledby': `tab-${k}`, tabindex: -1 }, content);
      const tab = h('button', { type: 'button', role: 'tab', id: `tab-${k}`, 'aria-controls': `panel-${k}`, onclick: () => this.openTab(k) }, label);
      tab.addEventListener('keydown', (event) => {
        const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
        if (step === 0) return;
        event.preventDefault();
        event.stopPropagation();
        const next = (k + step + this.tabs.length) % this.tabs.length;
        this.openTab(next);
        this.tabs[next].button.focus();
      });
      list.append(tab);
      side.append(panel);
      this.tabs.push({ button: tab, panel });
    });
    this.openTab(0);
    return side;
  }

  private openTab(index: number): void {
    this.tabs.forEach(({ button: tab, panel }, k) => {
      tab.setAttribute('aria-selected', String(k === index));
      tab.tabIndex = k === index ? 0 : -1;
      panel.hidden = k !== index;
    });
  }

  private listenToPointer(): void {
    let down: { x: number; y: number } | null = null;
    this.stage.canvas.addEventListener('pointerdown', (event) => (down = event.button === 0 ? { x: event.clientX, y: event.clientY } : null));
    this.stage.canvas.addEventListener('pointerup', (event) => {
      if (!down || Math.hypot(event.clientX - down.x, event.clientY - down.y) > 4) return;
      const found = this.stage.pickAt(event.clientX, event.clientY);
      if (found?.part) this.choosePart(found.part);
      else this.choose(found?.body ?? -1, found?.vertex ?? null, true);
    });
    this.stage.canvas.addEventListener('dblclick', (event) => {
      const found = this.stage.pickAt(event.clientX, event.clientY);
      if (found) this.goTo(found.body);
      else this.fit();
    });
  }
}
