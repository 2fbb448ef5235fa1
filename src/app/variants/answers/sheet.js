// The sheet: blocks of members, by axes.

const buttons = new Map();

function memberButton(cell) {
  const member = data.members[cell.member];
  if (!member.picture) {
    return made("span", { className: "none", textContent: member.note || member.state });
  }
  const button = made("button", { className: "member", title: member.name }, made("img", { src: member.picture, alt: member.name }));
  if (cell.caption) button.append(cell.caption);
  if (member.note) button.append(made("span", { className: "ended", textContent: member.note }));
  button.addEventListener("click", (event) => choose(event.shiftKey ? "b" : "a", cell.member));
  buttons.set(cell.member, button);
  return button;
}

function blockTable(block) {
  const table = made("table");
  if (block.rows.length > 0) {
    const corner = made("th", { className: "corner", textContent: `${block.rowAxis} ↓ ${block.columnAxis} →` });
    const heads = block.columns.map((label) => made("th", { scope: "col", textContent: label }));
    table.append(made("tr", {}, corner, ...heads));
  }
  const [rows, columns] = block.extent;
  for (let row = 0; row < rows; row++) {
    const line = made("tr");
    if (block.rows.length > 0) line.append(made("th", { scope: "row", textContent: block.rows[row] }));
    for (let column = 0; column < columns; column++) {
      const cell = block.cells.find((cell) => cell.row === row && cell.column === column);
      const place = made("td");
      if (cell) {
        place.append(memberButton(cell));
        if (!data.members[cell.member].picture && cell.caption) place.append(cell.caption);
      }
      line.append(place);
    }
    table.append(line);
  }
  return table;
}

for (const block of data.blocks) {
  const part = made("div");
  if (block.title) part.append(made("h3", { textContent: block.title }));
  part.append(blockTable(block));
  byId("sheet").append(part);
}

function markSheet() {
  for (const [member, button] of buttons) {
    button.classList.toggle("is-a", member === chosen.a);
    button.classList.toggle("is-b", member === chosen.b);
  }
}
listeners.push(markSheet);
markSheet();
