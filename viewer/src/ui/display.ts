// Settings of the view: deformation, colours, camera, layers.

import type { SceneData } from '../data/scene_data';
import type { Layer } from '../scene/connections';
import type { MapName } from '../scene/palette';
import { travelling } from '../scene/framing';
import type { Stage } from '../scene/stage';
import type { Colours } from './colours';
import { check, h } from './dom';
import type { Legend } from './legend';

const MOST = 1000;

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
  private readonly limits = h('div', { class: 'row limits', hidden: true }, this.low, h('span', {}, 'to'), this.high);

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
    const choice = this.colours.choice(this.field);
    this.stage.setColour(choice);
    this.legend.show(choice, this.colours.unit(this.field), this.relative && (this.field === null || this.colours.isStress(this.field)), this.colours.note(this.field));
    this.showLimits();
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
    const map = h('select', { class: 'field', 'aria-label': 'Colour map' }, h('option', { value: 'viridis' }, 'Viridis'), h('option', { value: 'cividis' }, 'Cividis'));
    map.addEventListener('change', () => {
      this.colours.map = map.value as MapName;
      this.apply();
    });
    this.element.append(h('div', { class: 'setting' }, h('div', { class: 'setting-head' }, 'Colour'), h('div', { class: 'row' }, select, map), this.relative ? null : this.limits));
    const leftOut = this.colours.leftOut();
    if (leftOut) this.element.append(h('p', { class: 'hint' }, leftOut));
    for (const [k, input] of [this.low, this.high].entries()) {
      input.addEventListener('change', () => {
        const range = this.colours.choice(this.field).range.slice() as [number, number];
        range[k] = Number(input.value);
        if (input.value !== '' && Number.isFinite(range[k]) && range[0] < range[1]) this.colours.setRange(this.field!, range);
        this.apply();
      });
    }
  }

  /** Limits of the scale can be typed, of what has a scale in its own unit. */
  private showLimits(): void {
    this.limits.hidden = typeof this.field !== 'string';
    if (this.limits.hidden) return;
    const [low, high] = this.colours.choice(this.field).range;
    this.low.value = String(Number(low.toPrecision(4)));
    this.high.value = String(Number(high.toPrecision(4)));
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
