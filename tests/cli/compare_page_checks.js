// Drives the controls of the page of facet compare --html, for compare_page_test.cpp.
const byId = (id) => document.getElementById(id);
const results = {};
const colour = (id, x, y) =>
    Array.from(byId(id).getContext('2d').getImageData(x, y, 1, 1).data.slice(0, 3));
const shown = (id) => getComputedStyle(byId(id)).visibility === 'visible' &&
    byId(id).getBoundingClientRect().width > 0;
const state =
    () => ['canvas-a', 'canvas-map', 'divider', 'swipe', 'legend'].filter(shown).join(' ');
const press = (key) =>
    document.body.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}));
const set = (id, value, type) => {
  byId(id).value = value;
  byId(id).dispatchEvent(new Event(type));
};
const point = (x, y, buttons) => byId('stage').dispatchEvent(new PointerEvent('pointermove', {
  clientX: byId('stage').getBoundingClientRect().left + x,
  clientY: byId('stage').getBoundingClientRect().top + y,
  buttons
}));
const texts = (selector) => Array.from(document.querySelectorAll(selector), (e) => e.textContent);

// WCAG 2.1: relative luminance, and contrast against the page.
const luminance = (codes) =>
    codes.slice(0, 3)
        .map((v) => v / 255)
        .map((v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
        .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
const luminanceOf = (colour) => luminance(colour.match(/[\d.]+/g).map(Number));
const background = () => luminanceOf(getComputedStyle(document.body).backgroundColor);
const contrast = (selector) => {
  const ink = luminanceOf(getComputedStyle(document.querySelector(selector)).color);
  return (Math.max(ink, background()) + 0.05) / (Math.min(ink, background()) + 0.05);
};

results.title = document.title;
results.heading = document.querySelector('h1').innerText;
results.sizes =
    ['canvas-a', 'canvas-b', 'canvas-map'].map((id) => [byId(id).width, byId(id).height]);
results.a = [colour('canvas-a', 0, 0), colour('canvas-a', 1, 0), colour('canvas-a', 3, 2)];
results.b = [colour('canvas-b', 0, 0), colour('canvas-b', 1, 0)];

results.swipe = state();
results.clip = byId('canvas-a').style.clipPath;
set('swipe', 25, 'input');
results.clip25 = byId('canvas-a').style.clipPath;
results.divider = byId('divider').style.left;
press('f');
results.flipped = state();
press('f');
results.flippedTwice = state();
press('2');
results.key2 = state();
results.clipA = byId('canvas-a').style.clipPath;
document.querySelector('input[name=view][value=map]').click();
results.map = state();

results.maps = [0, 1, 2].map((i) => {
  set('map', i, 'change');
  return {
    equal: luminance(colour('canvas-map', 35, 25)),
    worse: luminance(colour('canvas-map', 0, 0)),
    missing: colour('canvas-map', 3, 2),
    ticks: texts('#ticks span'),
    note: byId('map-note').textContent,
  };
});
results.scale = Array.from({length: 256}, (_, x) => luminance(colour('scale', x, 0)));

set('exposure', 1, 'input');
results.brighter = colour('canvas-b', 1, 0);
results.exposure = byId('exposure-value').textContent;
set('zoom', 4, 'change');
results.stage =
    [byId('stage').getBoundingClientRect().width, byId('stage').getBoundingClientRect().height];
results.buttons = texts('.goto');
document.querySelectorAll('.goto')[1].click();
results.readout = byId('readout').textContent;
results.marked = shown('marker');
point(5, 1, 0);
results.pointed = byId('readout').textContent;
set('swipe', 50, 'input');
point(12, 1, 1);
results.dragged = byId('canvas-a').style.clipPath;

results.commands = texts('.commands code');
results.origins = texts('section:last-of-type tbody')[0];
results.metrics = texts('[aria-labelledby=metrics-title] tbody th');
results.bars = Array.from(
    document.querySelectorAll('svg[role=img]'), (svg) => svg.querySelectorAll('.bar').length);
results.contrast = Math.min(
    ...['body', 'header p', 'th', 'figcaption', 'kbd', '.fails li', '.differs td', 'code'].map(
        contrast));
results.background = background();
