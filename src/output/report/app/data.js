// What the page holds: its data, unpacked. Texts reach the page through textContent only.

const scene = JSON.parse(document.getElementById("scene").textContent);
const root = document.documentElement;
const $ = (id) => document.getElementById(id);
const style = (name) => getComputedStyle(root).getPropertyValue(name).trim();
root.classList.add("script");

function bytes(base64) {
  const text = atob(base64);
  const all = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) all[i] = text.charCodeAt(i);
  return all.buffer;
}

const indices = ({ bits, base64 }) =>
  bits === 16 ? new Uint16Array(bytes(base64)) : new Uint32Array(bytes(base64));

function points(base64) {
  const steps = new Uint16Array(bytes(base64));
  const { origin, step } = scene.grid;
  const places = new Float32Array(steps.length);
  for (let i = 0; i < steps.length; i++) places[i] = origin[i % 3] + steps[i] * step;
  return places;
}
