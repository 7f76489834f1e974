"""The document in one file: a page that needs nothing but a browser, and computes by itself.

`write` makes the file: `values` has what is shown of each value, formulas in a `font` of their own, texts from
Markdown, and `page.js` keeps the shown numbers at what `evaluate` gives for the inputs. That function is written by
`javascript` from the recording, with what `numbers.js` computes and `find` solves. A drawing is `sketched` by the keys
of its numbers, and laid out by `drawing.js`; the `wording` of a text has its own, and `frames` has what else a slider
moves. What is out of view waits: `view.js`. Lists are typed into a `grid.js`. Numbers are shown in the units that are
`offered`, by `units.js`, and `put_in` formulas on demand.
Stands on the document room and those below.
"""
