// The page of a comparison: its words first, then its images.
const tag = (text) => element('b', {class: 'tag'}, text);

const describe = () => {
  document.title = `${data.image} against ${data.reference}`;
  for (const name of document.querySelectorAll('.image-name')) name.textContent = data.image;
  for (const name of document.querySelectorAll('.reference-name'))
    name.textContent = data.reference;
  byId('made').prepend(`${data.width} \u00d7 ${data.height} pixels. `);
  byId('made').append(` ${data.version}.`);
  const verdict = data.warnings.map((w) => element('p', {class: 'warning'}, `Warning: ${w}.`));
  if (data.violations.length > 0) {
    verdict.push(element(
        'div', {class: 'fails'}, element('p', {}, 'Thresholds that do not hold:'),
        element('ul', {}, ...data.violations.map((v) => element('li', {}, v)))));
  } else if (data.has_thresholds) {
    verdict.push(element('p', {class: 'holds'}, 'Every threshold holds.'));
  }
  byId('verdict').replaceChildren(...verdict);
  byId('metrics').append(table(
      ['Metric', 'Value', 'What it is'],
      data.metrics.map((m) => [m.name, cell(m.value), word(m.note)])));
  byId('histograms').append(...data.histograms.map(histogram));
};

/// A command whose lines break between options only.
const command = (name, text) => text === '' ?
    [] :
    [element(
        'div', {}, tag(name), ' ',
        element(
            'code', {},
            ...text.split(/ (?=--)/).flatMap(
                (part, i) => [...(i > 0 ? [' '] : []), element('span', {}, part)])))];
// JSON has no number for what is not finite.
const numberOf = (v, text) => v === null ? 'not finite' : text(v);
const colours = (values) => values.map((v) => numberOf(v, (x) => short(x))).join(' ');

/// Two rows a pixel: its values, and the commands that render it again.
const worstRows = (pixel) => {
  const [x, y] = pixel.pixel;
  const commands = [...command('A', pixel.image_command), ...command('B', pixel.reference_command)];
  const button = element(
      'button', {type: 'button', class: 'goto', 'data-x': x - data.x, 'data-y': y - data.y},
      `${x}, ${y}`);
  const values = [
    colours(pixel.image), colours(pixel.reference),
    numberOf(pixel.relative_error, (v) => short(v, 4)), numberOf(pixel.flip, (v) => v.toFixed(3))
  ];
  const row = element(
      'tr', commands.length > 0 ? {class: 'values'} : {}, element('th', {scope: 'row'}, button),
      ...values.map((v) => element('td', {class: 'number'}, v)));
  if (commands.length === 0) return [row];
  return [
    row, element('tr', {class: 'commands'}, element('td'), element('td', {colspan: 4}, ...commands))
  ];
};

const fillRows = (id, rows, columns, none) => byId(id).append(
    ...(rows.length > 0 ? rows : [element('tr', {}, element('td', {colspan: columns}, none))]));

describe();
fillRows('worst', data.worst.flatMap(worstRows), 5, 'No pixel differs.');
fillRows(
    'origins',
    data.origins.map(
        (o) => element(
            'tr', o.a === o.b ? {} : {class: 'differs'}, element('th', {scope: 'row'}, o.key),
            element('td', {}, o.a), element('td', {}, o.b))),
    3, 'The files do not say.');
byId('canvas-a').setAttribute('aria-label', `A, the image ${data.image}`);
byId('canvas-b').setAttribute('aria-label', `B, the reference ${data.reference}`);
for (const id of ['canvas-a', 'canvas-b', 'canvas-map']) {
  byId(id).width = data.width;
  byId(id).height = data.height;
}

const {width, height} = data;
const section = byId('images'), stage = byId('stage'), scroll = byId('scroll'),
      swipe = byId('swipe'), exposure = byId('exposure');
const a = pixelsOf(data.a), b = pixelsOf(data.b);
const maps = data.maps.map((m) => ({...m, codes: bytesOf(m.codes)}));

const drawImages = () => {
  const factor = 2 ** Number(exposure.value);
  byId('exposure-value').textContent = exposureText(Number(exposure.value));
  paintLinear(byId('canvas-a'), a, factor);
  paintLinear(byId('canvas-b'), b, factor);
};
const mapOf = () => maps[byId('map').value];
const drawMap = () => {
  const map = mapOf();
  paint(byId('canvas-map'), (i) => palette[map.codes[i]]);
  byId('map-note').textContent =
      `${map.name}: ${map.note}${map.logarithmic ? ', logarithmic' : ''}.`;
  const count = map.logarithmic ? Math.round(Math.log10(map.high / map.low)) : 5;
  byId('ticks').replaceChildren(...Array.from({length: count + 1}, (_, i) => {
    const tick = document.createElement('span');
    const value = map.logarithmic ? map.low * 10 ** i : i / count;
    tick.textContent = String(Number(value.toPrecision(3)));
    tick.style.left = `${100 * i / count}%`;
    return tick;
  }));
};
const valueOf = (map, code) => {
  if (code === 255) return 'undefined';
  if (!map.logarithmic) return (code / 254).toFixed(2);
  return code === 0 ? '0' : (map.low * (map.high / map.low) ** ((code - 1) / 253)).toPrecision(2);
};

const setSwipe = (percent) => {
  swipe.value = percent;
  byId('divider').style.left = `${swipe.value}%`;
  byId('canvas-a').style.clipPath =
      section.dataset.view === 'swipe' ? `inset(0 ${100 - swipe.value}% 0 0)` : 'none';
};
const setView = (name) => {
  document.querySelector(`input[name=view][value=${name}]`).checked = true;
  section.dataset.view = name;
  setSwipe(swipe.value);
};
const flip = () => setView(section.dataset.view === 'a' ? 'b' : 'a');
const setZoom = () => {
  const zoom = Number(byId('zoom').value);
  const fit = Math.min(scroll.clientWidth / width, 0.72 * window.innerHeight / height);
  const factor = zoom || (fit >= 2 ? Math.floor(fit) : Math.max(fit, 1e-3));
  stage.style.width = `${width * factor}px`;
  stage.style.height = `${height * factor}px`;
};

const pixelAt = (event) => {
  const box = stage.getBoundingClientRect();
  const x = Math.floor((event.clientX - box.left) / box.width * width);
  const y = Math.floor((event.clientY - box.top) / box.height * height);
  return x >= 0 && y >= 0 && x < width && y < height ? [x, y] : null;
};
const triple =
    (values, i) => [0, 1, 2].map((c) => String(Number(values[3 * i + c].toPrecision(4)))).join(' ');
const read = (x, y) => {
  const i = y * width + x;
  const errors = maps.map((m) => `${m.name} ≈ ${valueOf(m, m.codes[i])}`).join(', ');
  byId('readout').textContent =
      `pixel ${x + data.x}, ${y + data.y}: ${errors}\nA ${triple(a, i)}   B ${triple(b, i)}`;
};
const mark = (x, y) => {
  const marker = byId('marker');
  marker.hidden = false;
  marker.style.left = `calc(${100 * (x + 0.5) / width}% - 9px)`;
  marker.style.top = `calc(${100 * (y + 0.5) / height}% - 9px)`;
  marker.style.width = marker.style.height = '18px';
  read(x, y);
  marker.scrollIntoView({block: 'center', inline: 'center'});
};

byId('map').append(...maps.map((m, i) => new Option(m.name, i)));
paint(byId('scale'), (i) => palette[Math.min(i, 254)]);
for (const input of document.querySelectorAll('input[name=view]'))
  input.addEventListener('change', () => setView(input.value));
byId('flip').addEventListener('click', flip);
byId('map').addEventListener('change', () => {
  drawMap();
  setView('map');
});
byId('zoom').addEventListener('change', setZoom);
window.addEventListener('resize', setZoom);
exposure.addEventListener('input', drawImages);
swipe.addEventListener('input', () => setView('swipe'));
stage.addEventListener('pointermove', (event) => {
  const pixel = pixelAt(event);
  if (pixel) read(...pixel);
  if (event.buttons & 1 && section.dataset.view === 'swipe') {
    const box = stage.getBoundingClientRect();
    setSwipe(100 * (event.clientX - box.left) / box.width);
  }
});
for (const button of document.querySelectorAll('.goto'))
  button.addEventListener('click', () => mark(Number(button.dataset.x), Number(button.dataset.y)));
document.addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === 'SELECT') return;
  if (event.key === 'f' || event.key === 'F') flip();
  const name = {1: 'swipe', 2: 'a', 3: 'b', 4: 'map'}[event.key];
  if (name) setView(name);
});
drawImages();
drawMap();
setZoom();
setView('swipe');
