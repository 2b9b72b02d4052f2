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
  return { get value() { return Number(list.value); }, list };
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
  return {
    get value() { return Number(input.value); },
    set value(next) { input.value = next; tell(); },
    get disabled() { return input.disabled; },
    set disabled(is) { input.disabled = is; box.classList.toggle("off", is); },
  };
}

// A slider over the cycle's states with a button that lets them run.
function timeSlider(place, changed) {
  const start = page.named.length ? page.named[0].state : 0;
  const time = slider(place, "time", count.time - 1, start, moment, changed);
  const button = element("button", { type: "button" }, "Play");
  let timer = null;
  button.addEventListener("click", () => {
    if (timer) timer = clearInterval(timer);
    else timer = setInterval(() => { time.value = (time.value + 1) % count.time; changed(); }, 250);
    button.textContent = timer ? "Stop" : "Play";
  });
  place.append(button);
  return time;
}

// Draws one after the other, and only the newest wish of those that came meanwhile.
function latest(draw) {
  let running = false, again = false;
  return async function run() {
    if (running) { again = true; return; }
    running = true;
    do { again = false; await draw(); } while (again);
    running = false;
  };
}
