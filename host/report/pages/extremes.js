const verdict = (row) => row.holds ? 'holds' : row.argued ? 'argued' : 'FAILS';
const notes =
    (row) => [!row.holds && row.promise && `lost: ${row.promise}`, row.argued].filter(Boolean).join(
        '; ');
const worst = (row) => row.worst === null ? 'not finite' : short(row.worst, 4);

byId('device').textContent = data.device;
byId('made').append(` ${data.version}, ${data.driver}${
    data.quick ? '; a sample of the inputs (--quick)' :
                 ''}${data.complete ? '' : '; interrupted: these are the rows until then'}`);
const counted = (v) => data.rows.filter((row) => verdict(row) === v).length;
const summary = `${counted('holds')} of ${data.rows.length} rows hold, ${
    counted('argued')} are argued, ${counted('FAILS')} fail`;
byId('made').after(element('p', {id: 'summary'}, summary));
for (const group of new Set(data.rows.map((row) => row.group))) {
  byId('sections')
      .append(element(
          'section', {}, element('h2', {}, group),
          table(
              [
                'row', 'inputs', 'how many', 'worst', 'at most', 'unit', 'verdict', 'worst input',
                ''
              ],
              data.rows.filter((row) => row.group === group)
                  .map(
                      (row) =>
                          [row.name, word(row.range), cell(prefixed(row.inputs)), cell(worst(row)),
                           cell(short(row.limit, 4)), word(row.unit), word(verdict(row)),
                           word(row.at), word(notes(row))]))));
}
