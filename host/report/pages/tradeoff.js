// The page of facet tradeoff.
const percent = (relative) => `${short(100 * relative, 3)} %`;
const errorOf = (relmse) => percent(Math.sqrt(Math.max(relmse, 0)));
const errorText = (p) => p.at_reference ? 'too small to measure' : errorOf(p.relmse);
const between = ([low, high]) =>
    low > 0 && high !== null ? `${short(low, 2)} to ${short(high, 2)}` : 'unknown';
const biasText = (p) => !p.biased ? 'none seen' :
    p.bias > 0                    ? `${short(100 * p.bias, 2)} %` :
                                    'too small to see';

/// Points of one setting each, by their number of samples.
const settings = [];
for (const p of data.points) {
  const known = settings.find((s) => s.name === p.name);
  if (known) {
    known.points.push(p);
  } else {
    settings.push({name: p.name, points: [p]});
  }
}

const describe = () => {
  document.title = `facet tradeoff: ${data.scene}`;
  byId('scene').textContent = data.scene;
  byId('made').prepend(`${data.width} \u00d7 ${data.height} pixels on ${data.device}, ${
      data.driver}; ${data.seeds} renders of each point. `);
  byId('made').append(` ${data.version}.`);
  byId('reference').textContent = `Reference: ${data.reference.text}.`;
  const advice = [element(
      'p', {},
      `Best: ${data.best.name}, ${
          short(data.best.efficiency_ratio_expected, 3)} times the default. `,
      element('code', {}, data.best.command))];
  for (const [r, words] of [
           [data.recommendation, ''],
           [data.biased_recommendation, 'with a bias that --error does not see: ']]) {
    if (!r) continue;
    advice.push(element(
        'p', {},
        `Soonest at an error of ${percent(data.wanted_error)}, ${words}${r.name}, about ${
            short(r.seconds, 2)} s at ${data.own_width} \u00d7 ${data.own_height} pixels. `,
        element('code', {}, r.command)));
  }
  byId('advice').append(...advice);
};

const plot = () => {
  const pointOf =
      (p) => [p.seconds, Math.sqrt(p.relmse), ` s, ${p.spp} samples a pixel: ${p.command}`];
  const lineOf = (setting, name) => ({
    name,
    points: setting.points.filter((p) => !p.at_reference).map(pointOf),
  });
  const best = settings.find((s) => s.name === data.best.name);
  const plain = settings.find((s) => s.name === 'default');
  const front =
      data.points.filter((p) => p.front && !p.at_reference).sort((p, q) => p.seconds - q.seconds);
  const lines = settings.map(
      (s) => ({...lineOf(s, s.points[0].biased ? `${s.name}, biased` : s.name), quiet: true}));
  lines.push({
    name: 'Pareto front',
    points: front.map((p) => {
      const [x, y, more] = pointOf(p);
      return [x, y, `${more} (${p.name})`];
    })
  });
  lines.push(lineOf(plain, 'default'));
  if (best !== plain) lines.push(lineOf(best, 'best'));
  byId('plot').append(lineChart(
      'Relative error against seconds', 'seconds of rendering', 'relative error', lines,
      'Each line is a setting; point at one to read which. Nothing that was measured is both ' +
          'faster and better than the points of the Pareto front.'));
};

const tables = () => {
  byId('settings')
      .append(table(
          [
            'setting', 'samples', 'seconds', 'error', 'trimmed', 'efficiency', 'measured',
            'trimmed', 'slope', 'bias', 'front'
          ],
          settings.map((s) => {
            const p = s.points.at(-1);
            return [
              s.name, cell(p.spp), cell(short(p.seconds, 3)), cell(errorText(p)),
              cell(errorOf(p.relmse_trimmed)), cell(short(p.efficiency_ratio_expected, 3)),
              cell(`${short(p.efficiency_ratio, 3)} (${between(p.efficiency_ratio_interval95)})`),
              cell(short(p.efficiency_ratio_trimmed, 3)),
              cell(p.slope === null ? '' : p.slope.toFixed(2)), cell(biasText(p)),
              word(s.points.some((q) => q.front) ? 'yes' : '')
            ];
          })));
  byId('commands')
      .append(table(
          ['setting', 'samples a pixel', 'seconds', 'error', 'command'],
          settings.flatMap(
              (s) => s.points.map(
                  (p) =>
                      [s.name, cell(p.spp), cell(short(p.seconds, 3)), cell(errorText(p)),
                       {text: element('code', {}, p.command), number: false}]))));
};

const pictures = () => {
  byId('pictures-section').hidden = data.pictures.length === 0;
  if (data.pictures.length === 0) return;
  const plain = settings.find((s) => s.name === 'default').points.at(-1);
  byId('equal-time').textContent = `What each setting makes in the ${
      short(plain.seconds, 3)} s that the default takes for ${plain.spp} samples a pixel.`;
  const width = data.image_width, height = data.image_height;
  const truth = pixelsOf(data.reference.pixels);
  const shown = [
    {name: 'reference', values: truth, caption: data.reference.text},
    ...data.pictures.map(
        (p) => ({
          name: p.name,
          values: pixelsOf(p.pixels),
          caption: `${p.spp} samples a pixel, ${short(p.seconds, 3)} s, error ${errorOf(p.relmse)}`
        }))
  ];
  for (const picture of shown) {
    picture.canvas = element(
        'canvas',
        {width, height, role: 'img', 'aria-label': `${picture.name}, ${picture.caption}`});
    byId('pictures')
        .append(element(
            'figure', {}, picture.canvas,
            element(
                'figcaption', {}, element('strong', {}, picture.name), element('br'),
                picture.caption)));
  }
  const relative = (values, i) => {
    let sum = 0;
    for (let c = 3 * i; c < 3 * i + 3; ++c)
      sum += (values[c] - truth[c]) ** 2 / (truth[c] ** 2 + data.epsilon) / 3;
    return Math.sqrt(sum);
  };
  // Four decades, from 0.1 % to 1000 %.
  const step = (error) => Math.round(254 * Math.min(Math.max((Math.log10(error) + 3) / 4, 0), 1));
  const draw = () => {
    const exposure = Number(byId('exposure').value), zoom = Number(byId('zoom').value);
    byId('exposure-value').textContent = exposureText(exposure);
    for (const {canvas, values} of shown) {
      canvas.style.width = `${width * zoom}px`;
      canvas.parentElement.style.width = `${width * zoom}px`;
      if (byId('show').value === 'image') {
        paintLinear(canvas, values, 2 ** exposure);
      } else {
        paint(canvas, (i) => palette[step(relative(values, i))]);
      }
    }
  };
  for (const id of ['show', 'zoom']) byId(id).addEventListener('change', draw);
  byId('exposure').addEventListener('input', draw);
  draw();
};

describe();
plot();
tables();
pictures();
