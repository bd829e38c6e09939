// The page: time, canvas, sliders. What moves, and how it looks, comes from the machines.
import load, { Shown, names } from "./machines.js";
import katex from "./katex.js";

const byId = (id) => document.getElementById(id);
const picture = byId("picture");
const energyPlot = byId("energy");
const driftPlot = byId("drift");
const COLOURS = ["--faint", "--body", "--contact", "--track", "--accent"];
const KEPT = 600;

let machine = null;
let running = !matchMedia("(prefers-reduced-motion: reduce)").matches;
let before = null;
let energies = [];
let drifts = [];
let view = { x: 0, y: 0, scale: 1 };

function palette() {
  const style = getComputedStyle(document.documentElement);
  return COLOURS.map((name) => style.getPropertyValue(name).trim());
}

// a canvas as sharp as the screen; its size in pixels of the page
function sharp(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}

function draw() {
  const { context, width, height } = sharp(picture);
  const colours = palette();
  const scene = machine.scene();
  const scale = height / (2 * scene[2]);
  view = { x: scene[0], y: scene[1], scale };
  const across = (x) => width / 2 + (x - view.x) * scale;
  const down = (y) => height / 2 - (y - view.y) * scale;
  context.lineJoin = context.lineCap = "round";
  let at = 3;
  while (at < scene.length) {
    const [kind, colour, thickness, count] = scene.slice(at, at + 4);
    at += 4;
    context.strokeStyle = context.fillStyle = colours[colour];
    context.lineWidth = thickness;
    context.beginPath();
    if (kind < 2) {
      for (let k = 0; k < count; k += 2) context.lineTo(across(scene[at + k]), down(scene[at + k + 1]));
    } else {
      context.arc(across(scene[at]), down(scene[at + 1]), scene[at + 2] * scale, 0, 2 * Math.PI);
    }
    if (kind === 0 || kind === 2) context.stroke();
    else { if (kind === 1) context.closePath(); context.fill(); }
    at += count;
  }
}

function drawEnergy() {
  const { context, width, height } = sharp(energyPlot);
  if (energies.length < 2) return;
  const colours = palette();
  const least = Math.min(...energies), most = Math.max(...energies);
  // a flat line looks flat: the plot covers at least a tenth of the energy
  const size = Math.max(Math.abs(least), Math.abs(most), 1e-12);
  const half = Math.max((most - least) * 0.6, size * 0.05);
  const middle = (least + most) / 2;
  context.strokeStyle = colours[3];
  context.lineWidth = 1.5;
  context.beginPath();
  energies.forEach((energy, k) => {
    context.lineTo(width * k / (KEPT - 1), height / 2 - (energy - middle) / half * height / 2);
  });
  context.stroke();
}

// decades of the drift plot, from the least up
const DECADES = [-18, -6];

// how far the state is off its constraints, on a logarithmic scale
function drawDrift() {
  if (driftPlot.hidden) return;
  const { context, width, height } = sharp(driftPlot);
  const colours = palette();
  const down = (decade) => height * (DECADES[1] - decade) / (DECADES[1] - DECADES[0]);
  const style = getComputedStyle(document.documentElement);
  context.font = "11px system-ui, sans-serif";
  context.fillStyle = style.getPropertyValue("--quiet").trim();
  context.strokeStyle = colours[0];
  context.lineWidth = 1;
  for (let decade = DECADES[0] + 3; decade < DECADES[1]; decade += 3) {
    context.beginPath();
    context.moveTo(0, down(decade));
    context.lineTo(width, down(decade));
    context.stroke();
    context.fillText(`1e${decade}`, 4, down(decade) - 3);
  }
  context.strokeStyle = colours[4];
  context.lineWidth = 1.5;
  context.beginPath();
  drifts.forEach((drift, k) => {
    const decade = Math.log10(Math.max(drift, 10 ** DECADES[0]));
    context.lineTo(width * k / (KEPT - 1), down(Math.min(decade, DECADES[1])));
  });
  context.stroke();
}

// the line in the diagram that says where the state stands
function moveDiagram() {
  const share = machine.diagram_share();
  const line = byId("diagram").querySelector(".now");
  if (share === undefined || !line) return;
  line.setAttribute("transform", `translate(${share * Number(line.dataset.width)} 0)`);
}

function drawDiagram() {
  const picture = machine.diagram();
  byId("diagram").hidden = picture === undefined;
  byId("diagram").innerHTML = picture ?? "";
}

// words with formulas between dollars
function words(text, line) {
  text.split("$").forEach((part, index) => {
    const span = document.createElement("span");
    if (index % 2) katex.render(part, span, { throwOnError: false });
    else span.textContent = part;
    line.append(span);
  });
}

function equations() {
  const box = byId("equations");
  box.replaceChildren();
  for (const equation of machine.equations()) {
    const line = document.createElement("div");
    if (!katex) line.textContent = equation;
    else if (equation.startsWith("\\begin")) katex.render(equation, line, { displayMode: true, throwOnError: false });
    else words(equation, line);
    box.append(line);
  }
}

function say() {
  byId("clock").textContent = `${machine.time().toFixed(1)} s`;
  const energy = machine.energy();
  let words = `energy ${energy.toPrecision(6)} J`;
  if (machine.is_conservative() && energies.length > 1) {
    const off = Math.max(...energies.map((e) => Math.abs(e - energies[0]))) / Math.max(Math.abs(energies[0]), 1e-12);
    words += `, conserved: off by ${off.toExponential(1)} of it since the last touch`;
  } else if (!machine.is_conservative()) {
    words += ", which what drives or carries the machine changes";
  }
  const off = machine.off_constraints();
  words += off === undefined
    ? "; the constraints hold exactly, since forbidden velocities are not in the state"
    : `; off the constraint by ${off.toExponential(1)}, below`;
  byId("balance").textContent = words;
}

function frame(now) {
  if (machine) {
    if (running && before !== null) {
      const fault = machine.advance(Math.min((now - before) / 1000, 0.1));
      if (fault !== undefined) {
        byId("fault").textContent = fault;
        setRunning(false);
      }
      energies.push(machine.energy());
      drifts.push(machine.off_constraints());
      if (energies.length > KEPT) { energies.shift(); drifts.shift(); }
    }
    draw();
    drawEnergy();
    drawDrift();
    moveDiagram();
    say();
  }
  before = now;
  requestAnimationFrame(frame);
}

function setRunning(on) {
  running = on;
  byId("run").textContent = on ? "Pause" : "Run";
}

function touched() {
  energies = [];
  drifts = [];
  byId("fault").textContent = "";
}

function sliders() {
  const box = byId("sliders");
  box.replaceChildren();
  for (let k = 0; k < machine.sliders(); k += 1) {
    const label = document.createElement("label");
    const words = document.createElement("span");
    const input = document.createElement("input");
    const value = document.createElement("output");
    const [least, most] = machine.range(k);
    words.textContent = machine.label(k);
    Object.assign(input, { type: "range", min: least, max: most, step: (most - least) / 200 });
    input.value = machine.value(k);
    value.textContent = machine.value(k).toPrecision(3);
    input.addEventListener("input", () => {
      machine.set(k, Number(input.value));
      value.textContent = machine.value(k).toPrecision(3);
      touched();
      drawDiagram();
    });
    label.append(words, input, value);
    box.append(label);
  }
}

function show(name) {
  machine?.free();
  machine = Shown.named(name) ?? null;
  if (!machine) return;
  touched();
  byId("title").textContent = machine.title();
  byId("text").textContent = machine.text();
  byId("declaration").textContent = machine.declaration();
  byId("report").textContent = machine.report();
  document.title = `${machine.title()} – nonholonomic`;
  for (const link of byId("machines").children) {
    if (link.hash === `#${name}`) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
  }
  driftPlot.hidden = machine.off_constraints() === undefined;
  equations();
  drawDiagram();
  sliders();
}

function chosen() {
  const name = location.hash.slice(1);
  return names().includes(name) ? name : names()[0];
}

function push(right, up) {
  machine?.push(right, up);
  touched();
}

byId("run").addEventListener("click", () => setRunning(!running));
byId("reset").addEventListener("click", () => { machine?.reset(); touched(); sliders(); drawDiagram(); });
picture.addEventListener("keydown", (event) => {
  const pushes = { ArrowLeft: [-0.3, 0], ArrowRight: [0.3, 0], ArrowUp: [0, 0.3], ArrowDown: [0, -0.3] };
  const [right, up] = pushes[event.key] ?? [];
  if (right !== undefined) { event.preventDefault(); push(right, up); }
});
let held = null;
picture.addEventListener("pointerdown", (event) => {
  held = [event.offsetX, event.offsetY];
  picture.setPointerCapture(event.pointerId);
});
picture.addEventListener("pointerup", (event) => {
  if (held) {
    const [x, y] = held;
    push((event.offsetX - x) / view.scale, (y - event.offsetY) / view.scale);
  }
  held = null;
});

await load({ module_or_path: new URL("machines_bg.wasm", import.meta.url) });
for (const name of names()) {
  const shown = Shown.named(name);
  const link = document.createElement("a");
  link.href = `#${name}`;
  link.textContent = shown.title();
  byId("machines").append(link);
  shown.free();
}
addEventListener("hashchange", () => show(chosen()));
setRunning(running);
show(chosen());
requestAnimationFrame(frame);

// what a test asks: the machine after some seconds, without waiting for frames
function tried(name, seconds) {
  const shown = Shown.named(name);
  const [first, scene] = [shown.energy(), shown.scene().join()];
  let fault;
  const begun = performance.now();
  for (let t = 0; t < seconds && fault === undefined; t += 1 / 60) fault = shown.advance(1 / 60);
  const result = {
    name, fault, moved: shown.scene().join() !== scene, conservative: shown.is_conservative(),
    drift: Math.abs(shown.energy() - first) / Math.max(Math.abs(first), 1e-12),
    off: shown.off_constraints() ?? 0, share: (performance.now() - begun) / (1000 * seconds),
  };
  shown.free();
  return result;
}
if (location.search === "?check") {
  const checked = document.createElement("pre");
  checked.id = "checked";
  checked.textContent = JSON.stringify(names().map((name) => {
    show(name);
    const page = document.documentElement;
    const lines = [...document.querySelectorAll("#equations > div")];
    // as formulas, or words without any
    const isSet = (line) => line.querySelector(".katex") || !/[\\$]/.test(line.textContent);
    return {
      ...tried(name, 5), wider: page.scrollWidth - page.clientWidth,
      equations: lines.length, set: lines.filter(isSet).length,
      wrong: document.querySelectorAll(".katex-error").length,
    };
  }));
  document.body.append(checked);
}
