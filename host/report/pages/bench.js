const figureText = (f, scale = 1, digits = 2) => `${(f.median * scale).toFixed(digits)} (${
    (f.min * scale).toFixed(digits)} to ${(f.max * scale).toFixed(digits)})`;
const figureCell = (f, scale, digits) => cell(f ? figureText(f, scale, digits) : '');
// Of any size: three digits.
const secondsText = (f) => `${short(f.median, 3)} (${short(f.min, 3)} to ${short(f.max, 3)})`;
const secondsCell = (f) => cell(f ? secondsText(f) : '');
const fixed = (v, digits) => cell(v === undefined ? '' : v.toFixed(digits));
// Lines connect meshes of one kind in many sizes.
const isGenerated = (row) => row.mesh.startsWith('generated-');
const bySize = (rows) => rows.filter(isGenerated).sort((p, q) => p.triangles - q.triangles);
/// Medians of a figure over the meshes' sizes.
const line = (name, rows, key) =>
    ({name, points: bySize(rows).filter((r) => r[key]).map((r) => [r.triangles, r[key].median])});
const section = (title, charts, ...rest) =>
    byId('sections')
        .append(element(
            'section', {}, element('h2', {}, title), element('div', {class: 'charts'}, ...charts),
            ...rest));

const rays = () => {
  const charts = ['camera', 'diffuse', 'shadow'].map((kind) => {
    const rows = data.traversal.filter((r) => r.rays === kind);
    return lineChart(`Million ${kind} rays a second`, 'triangles', 'M rays/s', [
      line('facet', rows, 'facet'), line('single rays', rows, 'embree1'),
      line('packets', rows, 'embree8')
    ]);
  });
  section(
      'Rays', charts,
      table(
          [
            'mesh', 'rays', 'facet, M/s', 'single rays, M/s', 'packets of 8, M/s', 'facet / single',
            'equal hits'
          ],
          data.traversal.map(
              (r) =>
                  [r.mesh, word(r.rays), figureCell(r.facet), figureCell(r.embree1),
                   figureCell(r.embree8), fixed(r.ratio_embree1, 2), fixed(r.equal_hits, 6)])));
};

const trees = () => section(
    'Trees', [lineChart(
                 'Seconds to build the BVH', 'triangles', 's',
                 [
                   line('facet', data.build, 'facet_seconds'),
                   line(data.yardstick, data.build, 'embree_seconds')
                 ])],
    table(
        [
          'mesh', 'triangles', 'build, s', 'bytes a triangle', 'SAH cost', 'other build, s',
          'other bytes'
        ],
        data.build.map(
            (r) =>
                [r.mesh, cell(r.triangles), secondsCell(r.facet_seconds),
                 fixed(r.facet_bytes / r.triangles, 1), fixed(r.facet_sah, 2),
                 secondsCell(r.embree_seconds),
                 fixed(r.embree_bytes && r.embree_bytes / r.triangles, 1)])));

/// A bar a scene, as long as its samples per second, parted by the stages' shares.
const bars = () => {
  const nameWidth = 200, width = 760, step = 26;
  const most = Math.max(...data.render.map((r) => r.samples_per_second));
  const shapes = data.render.flatMap((r, i) => {
    const y = 4 + i * step, length = (width - nameWidth - 70) * r.samples_per_second / most;
    let x = nameWidth;
    const parts = Object.entries(r.stages).map(([stage, share], k) => {
      const part =
          svg('rect', {class: `stage${k}`, x, y, width: length * share, height: 18},
              svg('title', {}, `${stage} ${Math.round(100 * share)} %`));
      x += length * share;
      return part;
    });
    return [
      label(nameWidth - 8, y + 14, 'end', r.scene, {class: 'name'}), ...parts,
      label(nameWidth + length + 6, y + 14, 'start', (r.samples_per_second * 1e-6).toFixed(2))
    ];
  });
  const stages = Object.keys(data.render[0].stages).join(', ');
  return figure(
      'Samples a second',
      `Million samples a second; the parts of a bar are the shares of ${
          stages}, from left to right.`,
      width, 4 + step * data.render.length, shapes);
};

const renders = () => {
  const stages = Object.keys(data.render[0].stages);
  section(
      'Whole renders', [], bars(),
      table(
          [
            'scene', 'integrator', 'samples a pixel', 'M samples/s', 'M rays/s', 'to start, s',
            'compiling, s', 'instructions', 'on the device', ...stages.map((s) => `${s}, %`)
          ],
          data.render.map(
              (r) =>
                  [r.scene, word(r.integrator), cell(r.spp),
                   figureCell(
                       {
                         median: r.samples_per_second,
                         min: r.samples_per_second_min,
                         max: r.samples_per_second_max
                       },
                       1e-6),
                   fixed(r.rays_per_second * 1e-6, 2), fixed(r.startup_seconds, 2),
                   fixed(r.compile_seconds, 2), cell(r.kernel_instructions),
                   cell(`${prefixed(r.device_bytes)}B`),
                   ...stages.map((s) => fixed(100 * r.stages[s], 0))])));
};

const growth = () => section(
    'Growth',
    data.growth.map(
        (g) => lineChart(
            'Seconds of a frame', g.of, 's',
            [{name: 'facet', points: g.points.map((p) => [p.number, p.seconds.median])}])),
    table(
        ['of', 'number', 'a frame, s'],
        data.growth.flatMap(
            (g) => g.points.map((p) => [g.of, cell(p.number), secondsCell(p.seconds)]))));

document.title = `facet bench: ${data.device}`;
byId('device').textContent = data.device;
const beside = data.yardstick ? `, beside ${data.yardstick}` : '';
byId('made').prepend(`${data.driver}, ${data.threads} threads${beside}. Made by `);
byId('made').append(` ${data.version}.`);
if (data.traversal.length > 0) rays();
if (data.build.length > 0) trees();
if (data.render.length > 0) renders();
if (data.growth.length > 0) growth();
