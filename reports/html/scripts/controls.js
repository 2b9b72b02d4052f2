// Small form controls, each with its label, that call back when they change.
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name in made && name !== "list") made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

let controlCount = 0;

// A label above its control; a label around it would be read out with all of the control's words.
function labelled(label, control, ...rest) {
  control.id = `control-${++controlCount}`;
  return element("div", { className: "control" }, element("label", { for: control.id }, label), control, ...rest);
}

function choice(place, label, options, changed, value = 0) {
  const list = element("select", {}, ...options.map((text, k) => element("option", { value: k }, text)));
  list.value = value;
  list.addEventListener("change", changed);
  place.append(labelled(label, list));
  return { get value() { return Number(list.value); }, set value(next) { list.value = next; } };
}

function slider(place, label, most, value, words, changed) {
  const output = element("output", {}, words(value));
  const input = element("input", { type: "range", min: 0, max: most, step: 1 });
  input.value = value;
  const tell = () => {
    output.textContent = words(Number(input.value));
    input.setAttribute("aria-valuetext", output.textContent);
  };
  tell();
  input.addEventListener("input", () => { tell(); changed(); });
  const box = labelled(label, input, output);
  box.classList.add("wide");
  place.append(box);
  return { get value() { return Number(input.value); }, set value(next) { input.value = next; tell(); } };
}
