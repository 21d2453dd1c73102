// Looks at the page of facet tradeoff --html and drives its controls, for tradeoff_cli_test.cpp.
const byId = (id) => document.getElementById(id);
const results = {};
const texts = (selector) => Array.from(document.querySelectorAll(selector), (e) => e.textContent);
const pixels = () => Array.from(document.querySelectorAll('#pictures canvas'), (canvas) => {
  const {width, height} = canvas;
  return Array.from(canvas.getContext('2d').getImageData(0, 0, width, height).data);
});
const brightness = (list) => list.map((data) => data.reduce((sum, v) => sum + v, 0));
const set = (id, value, type) => {
  byId(id).value = value;
  byId(id).dispatchEvent(new Event(type));
};

results.title = document.title;
results.advice = texts('#advice p');
results.plotted =
    Array.from(document.querySelectorAll('#plot svg circle'), (circle) => circle.textContent);
results.legend = texts('#plot svg .name');
results.settings = texts('#settings tbody th');
results.commands = texts('#commands code');
results.captions = texts('#pictures figcaption');
const before = brightness(pixels());
set('exposure', 2, 'input');
const after = brightness(pixels());
results.brighter = before.every((v, i) => after[i] > v);
set('show', 'error', 'change');
// The reference has no error against itself: all of its pixels have the colour of none.
results.colours = pixels().map(
    (data) => new Set(data.map((v, i) => i % 4 ? '' : data.slice(i, i + 3).join())).size - 1);
set('zoom', 4, 'change');
results.size = document.querySelector('#pictures canvas').getBoundingClientRect().width;
