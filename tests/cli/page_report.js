// Leaves what a script has found in an element of its own, for page_checks.h.
results.requests = performance.getEntriesByType('resource').map((entry) => entry.name);
results.nameless =
    Array.from(document.querySelectorAll('input, select, button, canvas, svg'))
        .filter((e) => !e.labels?.length && !e.getAttribute('aria-label') && !e.textContent.trim())
        .map((e) => e.outerHTML);
results.overflow = document.documentElement.scrollWidth - document.documentElement.clientWidth;
results.problems = problems;
const report = document.createElement('pre');
report.id = 'report';
// No character that HTML would escape.
report.textContent = 'BEGIN' +
    Array
        .from(
            new TextEncoder().encode(JSON.stringify(results)),
            (b) => b.toString(16).padStart(2, '0'))
        .join('') +
    'END';
document.body.append(report);
