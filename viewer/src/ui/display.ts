// Settings of the view: deformation, colours, camera, layers.

import type { SceneData } from '../data/scene_data';
import type { Layer } from '../scene/connections';
import { travelling } from '../scene/framing';
import type { BaseMap } from '../scene/palette';
import type { Stage } from '../scene/stage';
import type { Colours, Scope } from './colours';
import { check, h } from './dom';
import type { Legend } from './legend';

const MOST = 1000;

const SCOPES: [Scope, string][] = [
  ['run', 'Whole run, all bodies'],
  ['visible', 'Whole run, visible bodies'],
  ['body', 'Whole run, chosen body'],
  ['now', 'This instant, visible bodies'],
  ['percentile', 'Percentile of the places'],
  ['limit', "A material's limit"],
  ['typed', 'As typed'],
];
const MAPS: [BaseMap, string][] = [['viridis', 'Viridis'], ['cividis', 'Cividis'], ['turbo', 'Turbo']];
const BANDS: [number, string][] = [[0, 'Smooth'], [6, '6 bands'], [10, '10 bands'], [12, '12 bands']];

function choices<T extends string | number>(label: string, options: [T, string][], chosen: T): HTMLSelectElement {
  return h('select', { class: 'field', 'aria-label': label }, ...options.map(([value, text]) => h('option', { value, selected: value === chosen }, text)));
}

export class Display {
  readonly element = h('div', { class: 'display' });
  private readonly stage: Stage;
  private readonly colours: Colours;
  private readonly legend: Legend;
  private readonly relative: boolean;
  private field: string | null | undefined;
  private follow: HTMLSelectElement | null = null;
  readonly slider: HTMLInputElement;
  private readonly sliderText = h('output', {});
  private readonly low = h('input', { type: 'number', step: 'any', class: 'field', 'aria-label': 'Lower end of the scale' });
  private readonly high = h('input', { type: 'number', step: 'any', class: 'field', 'aria-label': 'Upper end of the scale' });
  private readonly scaleUnit = h('span', {});
  private readonly limits = h('div', { class: 'row limits', hidden: true }, this.low, h('span', {}, 'to'), this.high, this.scaleUnit);
  private readonly scope = choices('Scale of the colours', SCOPES, 'run');
  private readonly percent = h('input', { type: 'number', min: 50, max: 100, step: 'any', class: 'field', 'aria-label': 'Percent of the places that the scale holds' });
  private readonly limit = h('input', { type: 'number', min: 0, step: 'any', class: 'field', 'aria-label': "A material's limit" });
  private readonly limitUnit = h('span', {});
  private readonly percentRow = h('div', { class: 'row limits', hidden: true }, this.percent, h('span', {}, '% of the places'));
  private readonly limitRow = h('div', { class: 'row limits', hidden: true }, h('span', {}, 'Limit'), this.limit, this.limitUnit);
  private colourBy: HTMLSelectElement | null = null;
  /** What the scale was last computed from. */
  private seen = '';

  constructor(stage: Stage, colours: Colours, legend: Legend) {
    this.stage = stage;
    this.colours = colours;
    this.legend = legend;
    const { scene } = stage;
    const swings = scene.vibrations.length > 0;
    this.relative = scene.kind === 'reduce' || swings;
    this.field = scene.kind === 'check' || colours.scalars.length === 0 ? undefined : colours.scalars[0].field;
    const what = swings ? 'Amplitude' : 'Deformation';
    const [low, high] = swings ? [-1, 0.5] : this.relative ? [-1, 1] : [0, Math.log10(MOST)];
    this.slider = h('input', { type: 'range', min: low, max: high, step: 0.01, value: 0, 'aria-label': `${what} scale` });
    this.slider.addEventListener('input', () => this.setScale(10 ** Number(this.slider.value)));
    if (swings || scene.bodies.some((body) => body.mesh?.modes)) {
      this.element.append(h('div', { class: 'setting' }, h('div', { class: 'setting-head' }, h('span', {}, what), this.sliderText), this.slider));
    }
    if (colours.scalars.length > 0) this.addColours();
    if (scene.time.length > 1) this.addFollow(scene);
    this.addLayers(scene);
    this.setScale(1);
    this.apply();
  }

  setScale(scale: number): void {
    const rounded = scale < 10 ? Math.round(scale * 100) / 100 : scale < 100 ? Math.round(scale * 10) / 10 : Math.round(scale);
    this.stage.setScale(rounded);
    this.slider.value = String(Math.log10(rounded));
    this.sliderText.textContent = `${rounded}×`;
    this.slider.setAttribute('aria-valuetext', `${rounded} times`);
    const part = (Number(this.slider.value) - Number(this.slider.min)) / (Number(this.slider.max) - Number(this.slider.min));
    this.slider.style.setProperty('--part', `${(100 * part).toFixed(1)}%`);
  }

  apply(): void {
    const { colours, field } = this;
    this.seen = this.signature();
    const choice = colours.choice(field);
    this.stage.setColour(choice);
    if (field === undefined) this.legend.show(null);
    else {
      const relative = this.relative && (field === null || colours.isStress(field));
      const { name, factor } = colours.unit(field);
      const what = field ?? (relative ? 'Displacement' : 'Elastic displacement');
      const [low, high] = choice.scale;
      this.legend.show({
        title: relative ? `${what} of the mode, relative` : name ? `${what} [${name}]` : what,
        scale: relative ? [low < 0 ? -1 : 0, 1] : [low * factor, high * factor],
        map: choice.map,
        beyond: colours.beyond(field),
        scope: colours.scopeText(field),
        note: colours.note(field),
      });
    }
    this.showLimits();
  }

  /** Another scale if that depends on the time, on what is visible or on what is chosen. */
  keepUp(): void {
    if (this.seen !== this.signature()) this.apply();
  }

  private signature(): string {
    const { stage, colours } = this;
    if (this.field === undefined || this.relative) return '';
    return JSON.stringify([stage.bodies.map((body) => body.group.visible), stage.selected?.body ?? -1, colours.moves ? [stage.motion.frame, stage.motion.part] : 0]);
  }

  /** Colours by a field, if any body has it. */
  setField(field: string | null): void {
    const k = this.colours.scalars.findIndex((scalar) => scalar.field === field);
    if (k < 0) return;
    this.field = field;
    if (this.colourBy) this.colourBy.value = String(k);
    this.apply();
  }

  get shownField(): string | null | undefined {
    return this.field;
  }

  setFollow(body: number): void {
    this.stage.setFollow(body);
    if (this.follow) this.follow.value = String(body);
  }

  private addColours(): void {
    const BODIES = 'bodies';
    const select = h(
      'select',
      { class: 'field', 'aria-label': 'Colour by' },
      ...this.colours.scalars.map((scalar, k) => h('option', { value: k, selected: scalar.field === this.field && this.field !== undefined }, scalar.label)),
      h('option', { value: BODIES, selected: this.field === undefined }, 'Bodies'),
    );
    select.addEventListener('change', () => {
      this.field = select.value === BODIES ? undefined : this.colours.scalars[Number(select.value)].field;
      this.apply();
    });
    this.colourBy = select;
    const map = choices('Colour map', MAPS, 'viridis');
    map.addEventListener('change', () => {
      this.colours.base = map.value as BaseMap;
      this.apply();
    });
    const bands = choices('Bands of colour', BANDS, 0);
    bands.addEventListener('change', () => {
      this.colours.bands = Number(bands.value);
      this.apply();
    });
    this.element.append(h('div', { class: 'setting' }, h('div', { class: 'setting-head' }, 'Colour'), select, h('div', { class: 'row maps' }, map, bands)));
    const leftOut = this.colours.leftOut();
    if (leftOut) this.element.append(h('p', { class: 'hint' }, leftOut));
    if (!this.relative) this.addScale();
  }

  private addScale(): void {
    const { colours } = this;
    this.element.append(h('div', { class: 'setting' }, h('div', { class: 'setting-head' }, 'Scale'), this.scope, this.percentRow, this.limitRow, this.limits));
    this.scope.addEventListener('change', () => {
      colours.scope = this.scope.value as Scope;
      this.apply();
    });
    this.percent.addEventListener('change', () => {
      const value = Number(this.percent.value);
      if (this.percent.value !== '' && value >= 50 && value <= 100) colours.percent = value;
      this.apply();
    });
    this.limit.addEventListener('change', () => {
      const value = Number(this.limit.value);
      if (this.field !== undefined && this.limit.value !== '' && value > 0 && Number.isFinite(value)) colours.setLimit(this.field, value / colours.unit(this.field).factor);
      this.apply();
    });
    for (const [k, input] of [this.low, this.high].entries()) {
      input.addEventListener('change', () => {
        if (this.field === undefined) return;
        const range: [number, number] = [...colours.choice(this.field).scale];
        range[k] = Number(input.value) / colours.unit(this.field).factor;
        if (input.value !== '' && Number.isFinite(range[k]) && range[0] < range[1]) colours.type(this.field, range);
        this.apply();
      });
    }
  }

  /** Limits of the scale can be typed, of what has a scale in its own unit. */
  private showLimits(): void {
    const { colours, field } = this;
    const { name, factor } = colours.unit(field);
    this.scope.disabled = field === undefined;
    this.scope.value = colours.scope;
    this.limits.hidden = field === undefined;
    this.percentRow.hidden = field === undefined || colours.scope !== 'percentile';
    this.limitRow.hidden = field === undefined || colours.scope !== 'limit';
    if (field === undefined) return;
    const [low, high] = colours.choice(field).scale;
    this.low.value = String(Number((low * factor).toPrecision(4)));
    this.high.value = String(Number((high * factor).toPrecision(4)));
    this.scaleUnit.textContent = this.limitUnit.textContent = name;
    this.percent.value = String(colours.percent);
    const limit = colours.limit(field);
    this.limit.value = limit === undefined ? '' : String(Number((limit * factor).toPrecision(6)));
  }

  private addFollow(scene: SceneData): void {
    this.follow = h('select', { class: 'field', 'aria-label': 'Camera follows' }, h('option', { value: -1 }, 'Stands still'), ...scene.bodies.map((body) => h('option', { value: body.index }, `Follows ${body.name}`)));
    this.follow.addEventListener('change', () => this.stage.setFollow(Number(this.follow!.value)));
    this.element.append(h('div', { class: 'setting' }, h('div', { class: 'setting-head' }, 'Camera'), this.follow));
    this.setFollow(travelling(scene, this.stage.size));
  }

  private addLayers(scene: SceneData): void {
    const { stage } = this;
    const checking = scene.kind === 'check';
    const layers = h('div', { class: 'layers' });
    const add = (label: string, on: boolean, set: (on: boolean) => void): void => {
      set(on);
      layers.append(check(label, on, set));
    };
    const layer = (label: string, name: Layer, on: boolean): void => {
      if (stage.connections.count(name) > 0) add(label, on, (visible) => stage.setLayer(name, visible));
    };
    const names = { bodies: false, others: false };
    add('Names', checking, (on) => {
      names.bodies = on;
      stage.annotations.setNames(names.bodies, names.others);
    });
    // Many names cover each other.
    const count = stage.annotations.nameCount;
    if (count > scene.bodies.length) {
      add('More names', checking && count <= 24 || scene.kind === 'reduce', (on) => {
        names.others = on;
        stage.annotations.setNames(names.bodies, names.others);
      });
    }
    layer('Joints', 'joints', checking);
    layer('Springs, rods, couplings', 'springs', true);
    layer('Tyres', 'tyres', true);
    layer('Forces', 'loads', checking);
    add('Body axes', checking, (on) => {
      for (const view of stage.bodies) view.setTriad(on, 0.05 * stage.size);
      stage.invalidate();
    });
    if (scene.roads.length > 0) add('Road', true, (on) => this.show(() => (stage.roads.visible = on)));
    add('Ground', true, (on) => this.show(() => (stage.grid.mesh.visible = on)));
    if (stage.rest) add('At rest', true, (on) => this.show(() => (stage.still.visible = on)));
    add('Edges', true, (on) => this.show(() => stage.bodies.forEach((view) => view.setEdges(on))));
    if (scene.bodies.some((body) => body.mesh)) add('Mesh only', false, (on) => this.show(() => stage.bodies.forEach((view) => view.setWire(on))));
    const shells = stage.bodies.filter((view) => view.mesh && !view.flexible);
    if (shells.length > 0 && stage.bodies.some((view) => view.flexible)) add('See-through', false, (on) => this.show(() => shells.forEach((view) => view.setGhost(on))));
    if (stage.annotations.spiders.children.length > 0) add('Interfaces', true, (on) => this.show(() => (stage.annotations.spiders.visible = on)));
    this.element.append(h('div', { class: 'setting' }, h('div', { class: 'setting-head' }, 'Shown'), layers));
  }

  private show(change: () => void): void {
    change();
    this.stage.invalidate();
  }
}
