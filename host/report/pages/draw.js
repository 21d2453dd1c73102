// What the pages draw with. Whatever a page shows reaches it as text, never as markup.
const byId = (id) => document.getElementById(id);
const data = JSON.parse(byId('data').textContent);

const filled = (node, attributes, children) => {
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
};
const element = (name, attributes = {}, ...children) =>
    filled(document.createElement(name), attributes, children);
const svg = (name, attributes = {}, ...children) =>
    filled(document.createElementNS('http://www.w3.org/2000/svg', name), attributes, children);

const short = (v, digits = 6) => String(Number(v.toPrecision(digits)));
/// 1234567: "1.23 M".
const prefixed = (v) => {
  const steps = Math.min(Math.floor(Math.log10(Math.max(v, 1)) / 3), 4);
  return `${short(v / 1000 ** steps, 3)} ${['', 'k', 'M', 'G', 'T'][steps]}`;
};

/// Rows of cells; a row's first cell is its head, numbers are set as such.
const table = (heads, rows) => element(
    'div', {class: 'wide'},
    element(
        'table', {},
        element(
            'thead', {}, element('tr', {}, ...heads.map((h) => element('th', {scope: 'col'}, h)))),
        element(
            'tbody', {},
            ...rows.map(
                ([head, ...cells]) => element(
                    'tr', {}, element('th', {scope: 'row'}, head),
                    ...cells.map(
                        ({text, number = true}) =>
                            element('td', number ? {class: 'number'} : {}, text)))))));
const cell = (text) => ({text});
const word = (text) => ({text, number: false});

const figure = (title, caption, width, height, shapes) => element(
    'figure', {class: 'chart'},
    svg('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': title}, ...shapes),
    element('figcaption', {}, caption));
const label = (x, y, anchor, text, attributes = {}) =>
    svg('text', {x, y, 'text-anchor': anchor, ...attributes}, text);
const gridLine = (x1, x2, y) => svg('line', {class: 'grid', x1, x2, y1: y, y2: y});

/// A histogram as histogram_json (histogram.h) describes it.
const histogram = (h) => {
  const left = 52, right = 8, top = 22, bottom = 40, width = 480, height = 220;
  const inner = width - left - right, floor = height - bottom, most = Math.max(...h.counts);
  const xOf = (position) => left + position * inner;
  const yOf = (count) => floor - count / Math.max(1, most) * (floor - top);
  const shapes = [0, 0.5, 1]
                     .map((share) => Math.round(share * most))
                     .flatMap(
                         (count) =>
                             [gridLine(left, width - right, yOf(count)),
                              label(left - 6, yOf(count) + 4, 'end', count)]);
  const step = inner / h.counts.length;
  h.counts.forEach((count, i) => {
    if (count > 0)
      shapes.push(svg('rect', {
        class: 'bar',
        x: left + i * step,
        y: yOf(count),
        width: step - 0.8,
        height: floor - yOf(count)
      }));
  });
  const ticks = h.logarithmic ? h.high - h.low : 5;
  for (let i = 0; i <= ticks; ++i) {
    const text = short(h.logarithmic ? 10 ** (h.low + i) : i / ticks);
    shapes.push(label(xOf(i / ticks), floor + 16, i === ticks ? 'end' : 'middle', text));
  }
  shapes.push(label(xOf(0.5), height - 6, 'middle', h.axis, {class: 'axis'}));
  const {name, value, position} = h.mark;
  if (position >= 0 && position <= 1) {
    const x = xOf(position), isRight = position > 0.7;
    shapes.push(
        svg('line', {class: 'mark', x1: x, x2: x, y1: top - 4, y2: floor}),
        label(
            x + (isRight ? -4 : 4), top - 8, isRight ? 'end' : 'start',
            `${name} ${short(value, 3)}`, {class: 'mark'}));
  }
  return figure(
      `Histogram: ${h.title}`, `${h.title}. ${h.beside.join(' ')}`, width, height, shapes);
};

/// Numbers to write at a logarithmic axis: of 1, 2, 5, 10, ... those from below the least value to
/// above the greatest, or over many decades the powers of ten among them.
const logTicks = (least, greatest) => {
  const all = [];
  for (let decade = Math.floor(Math.log10(least)); decade <= Math.log10(greatest) + 2; ++decade)
    all.push(...[1, 2, 5].map((digit) => Number(`${digit}e${decade}`)));
  const from = all.findLastIndex((t) => t <= least * 1.0001);
  const to = Math.max(all.findIndex((t) => t >= greatest * 0.9999), from + 1);
  const ticks = all.slice(from, to + 1);
  if (ticks.length <= 9) return ticks;
  return ticks.filter((t, i) => i === 0 || i === ticks.length - 1 || Math.log10(t) % 1 === 0);
};

/// Lines of (x, y) > 0, both axes logarithmic; nothing without points. At most three have their
/// names above; the others are `quiet` and tell them when pointed at. A point may say more of
/// itself in a third place. The caption is the title where there is none.
const lineChart = (title, xAxis, yAxis, lines, caption) => {
  const drawn = lines.filter((line) => line.points.length > 0);
  if (drawn.length === 0) return '';
  const left = 56, right = 16, top = 34, bottom = 42, width = 480, height = 280;
  const classes = ['first', 'second', 'third'];
  const axis = (k, begin, end) => {
    const values = drawn.flatMap((line) => line.points.map((p) => p[k]));
    const ticks = logTicks(Math.min(...values), Math.max(...values));
    const place = (v) =>
        begin + Math.log(v / ticks[0]) / Math.log(ticks.at(-1) / ticks[0]) * (end - begin);
    return {ticks, place};
  };
  const x = axis(0, left, width - right), y = axis(1, height - bottom, top);
  const text = (v) => v >= 1e6 ? `${short(v / 1e6)}M` : v >= 1e3 ? `${short(v / 1e3)}k` : short(v);
  const shapes = y.ticks.flatMap(
      (t) =>
          [gridLine(left, width - right, y.place(t)),
           label(left - 6, y.place(t) + 4, 'end', text(t))]);
  shapes.push(...x.ticks.map((t) => label(x.place(t), height - bottom + 16, 'middle', text(t))));
  shapes.push(
      label((left + width - right) / 2, height - 6, 'middle', xAxis),
      label(width - right, 12, 'end', yAxis));
  const shapeOf = (line, kind) => {
    const at = line.points.map(([px, py]) => `${x.place(px).toFixed(1)} ${y.place(py).toFixed(1)}`);
    return svg(
        'g', {class: 'lines'},
        svg('path', {class: kind, style: 'fill:none', d: `M${at.join('L')}`}),
        svg('g', {class: kind},
            ...line.points.map(
                ([px, py, more = '']) => svg(
                    'circle', {cx: x.place(px), cy: y.place(py), r: 3},
                    svg('title', {}, `${line.name}: ${short(py, 3)} at ${short(px, 3)}${more}`)))));
  };
  shapes.push(...drawn.filter((line) => line.quiet).map((line) => shapeOf(line, 'quiet')));
  drawn.filter((line) => !line.quiet).forEach((line, i) => {
    shapes.push(
        shapeOf(line, classes[i]),
        svg('g', {class: 'lines'}, svg('path', {class: classes[i], d: `M${left + 110 * i} 24h22`})),
        label(left + 110 * i + 28, 28, 'start', line.name, {class: 'name'}));
  });
  return figure(title, caption ?? title, width, height, shapes);
};
