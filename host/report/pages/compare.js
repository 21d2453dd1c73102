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
const missing = [0, 184, 196];

const bytesOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

// The value of every 16-bit float, times the images' scale.
const halves = new Float32Array(65536);
for (let h = 0; h < 65536; ++h) {
  const exponent = (h >> 10) & 31, fraction = h & 1023;
  let v = exponent === 0 ? fraction * 2 ** -24 : (1024 + fraction) * 2 ** (exponent - 25);
  if (exponent === 31) v = fraction ? NaN : Infinity;
  halves[h] = (h & 0x8000 ? -v : v) * data.scale;
}
const pixelsOf = (text) => {
  const bytes = bytesOf(text), values = new Float32Array(bytes.length / 2);
  for (let i = 0; i < values.length; ++i)
    values[i] = halves[bytes[2 * i] | (bytes[2 * i + 1] << 8)];
  return values;
};
const a = pixelsOf(data.a), b = pixelsOf(data.b);
const maps = data.maps.map((m) => ({...m, codes: bytesOf(m.codes)}));

const encode = (linear) =>
    linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
// sRGB codes by interpolation in steps of the linear value's square root.
const encoded = Float32Array.from({length: 4098}, (_, i) => 255 * encode((i / 4096) ** 2));
const codeOf = (v) => {
  const x = 4096 * Math.sqrt(Math.min(Math.max(v, 0), 1)), i = Math.floor(x);
  return Math.round(encoded[i] + (encoded[i + 1] - encoded[i]) * (x - i));
};

// Colours of rising OKLab lightness (B. Ottosson, 2020) from near black over purple and orange to
// pale yellow, so that a larger error always looks brighter.
const colourOf = (t) => {
  const lightness = 0.12 + 0.85 * t, hue = (285 + 175 * t) * Math.PI / 180;
  const chroma = 0.02 + 0.19 * Math.sin(Math.PI * Math.min(1, 0.08 + 0.86 * t)) ** 0.9;
  const p = chroma * Math.cos(hue), q = chroma * Math.sin(hue);
  const l = (lightness + 0.3963377774 * p + 0.2158037573 * q) ** 3;
  const m = (lightness - 0.1055613458 * p - 0.0638541728 * q) ** 3;
  const s = (lightness - 0.0894841775 * p - 1.2914855480 * q) ** 3;
  return [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s
  ].map((v) => Math.round(255 * encode(Math.min(Math.max(v, 0), 1))));
};
const palette = Array.from({length: 256}, (_, i) => i === 255 ? missing : colourOf(i / 254));

const paint = (canvas, colour) => {
  const context = canvas.getContext('2d'),
        image = context.createImageData(canvas.width, canvas.height);
  for (let i = 0; i < image.data.length / 4; ++i) {
    const [red, green, blue] = colour(i);
    image.data.set([red, green, blue, 255], 4 * i);
  }
  context.putImageData(image, 0, 0);
};
const drawImages = () => {
  const factor = 2 ** Number(exposure.value);
  byId('exposure-value').textContent =
      (exposure.value > 0 ? '+' : '') + Number(exposure.value) + ' EV';
  for (const [id, values] of [['canvas-a', a], ['canvas-b', b]]) {
    paint(byId(id), (i) => {
      const red = values[3 * i], green = values[3 * i + 1], blue = values[3 * i + 2];
      return Number.isFinite(red + green + blue) ?
          [codeOf(factor * red), codeOf(factor * green), codeOf(factor * blue)] :
          missing;
    });
  }
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
