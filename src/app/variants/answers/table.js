// The table of numbers, sorted by any column.

// Three digits that say something.
function short(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "";
  const size = Math.abs(value);
  if (size === 0) return "0";
  if (size < 1e-3 || size >= 1e6) return value.toExponential(2);
  return value.toFixed(Math.max(2 - Math.floor(Math.log10(size)), 0));
}

// A column: its heading, a member's value, and how that is said. Numbers are sorted as numbers.
const word = (name, of) => ({ name, of, say: (value) => value ?? "", number: false });
const number = (name, of, say = short) => ({ name, of, say, number: true });
const numeric = (text) => text !== null && text.trim() !== "" && Number.isFinite(Number(text));
const columns = [word("member", (m) => m.name)];
data.paths.forEach((path, i) => {
  const values = data.members.map((m) => m.settings[i]).filter((value) => value !== null);
  const all = values.every(numeric);
  const of = (m) => (m.settings[i] === null ? null : all ? Number(m.settings[i]) : m.settings[i]);
  columns.push(all ? number(path, of, (value) => (value === null ? "" : String(value))) : word(path, of));
});
columns.push(
  number("spp", (m) => m.spp, (value) => value ?? ""),
  number("seconds", (m) => m.seconds),
  number("Mrays", (m) => (m.rays === null ? null : m.rays / 1e6)),
  number("error", (m) => m.error),
  number("efficiency", (m) => m.efficiency),
);
if (data.reference) {
  columns.push(
    number("relMSE", (m) => m.relmse),
    number("FLIP", (m) => m.flip),
    ...["R", "G", "B"].map((channel, i) => number(`mean ${channel}`, (m) => m.mean?.[i] ?? null, (v) => (v === null ? "" : v.toFixed(4)))),
  );
}
columns.push(word("", (m) => [m.state === "done" ? "" : m.state, m.note, m.filmOf && `film of ${m.filmOf}`, m.bad ? `${m.bad} bad samples` : ""].filter(Boolean).join("; ")));

const sorted = { column: -1, down: false };

// What has no value comes last, either way.
function order() {
  const members = [...data.members.keys()];
  const column = columns[sorted.column];
  if (!column) return members;
  const sign = sorted.down ? -1 : 1;
  return members.sort((i, j) => {
    const [a, b] = [column.of(data.members[i]), column.of(data.members[j])];
    const lacks = (a === null || a === "") - (b === null || b === "");
    if (lacks) return lacks;
    return sign * (column.number ? a - b : String(a).localeCompare(String(b), "en", { numeric: true })) || i - j;
  });
}

function fillTable() {
  const heads = columns.map((column, i) => {
    const mark = i === sorted.column ? (sorted.down ? " ↓" : " ↑") : "";
    const button = made("button", { textContent: column.name + mark });
    button.addEventListener("click", () => {
      sorted.down = i === sorted.column && !sorted.down;
      sorted.column = i;
      fillTable();
      byId("numbers").querySelectorAll("th button")[i].focus();
    });
    const head = made("th", { scope: "col", className: column.number ? "number" : "" }, button);
    head.ariaSort = i === sorted.column ? (sorted.down ? "descending" : "ascending") : "none";
    return head;
  });
  const rows = order().map((place) => {
    const member = data.members[place];
    const row = made("tr", { title: member.repeat });
    columns.forEach((column, i) => {
      const kind = column.number ? "number" : i === columns.length - 1 ? "long" : "";
      row.append(made("td", { className: kind, textContent: column.say(column.of(member)) }));
    });
    return row;
  });
  byId("numbers").replaceChildren(made("thead", {}, made("tr", {}, ...heads)), made("tbody", {}, ...rows));
}
fillTable();
