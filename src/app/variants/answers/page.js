// What the parts of the page share: the data, and which two members are compared.

const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);

// An element with properties and children.
function made(name, properties = {}, ...children) {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...children);
  return element;
}

// Members that have a picture, by their places.
const shown = data.members.map((member, place) => (member.picture ? place : -1)).filter((place) => place >= 0);

// Who is told when other members are compared.
const listeners = [];
const chosen = { a: shown[0] ?? -1, b: shown[1] ?? shown[0] ?? -1 };

function choose(side, member) {
  if (!data.members[member]?.picture) return;
  chosen[side] = member;
  listeners.forEach((tell) => tell());
}

byId("small").hidden = !data.small;
byId("compare").hidden = shown.length === 0;
