// The data of the page: JSON in which long arrays are base64 of little-endian numbers.

function bytes(text) {
  const binary = atob(text);
  const array = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) array[i] = binary.charCodeAt(i);
  return array.buffer;
}

const float32 = (text) => new Float32Array(bytes(text));
const float64 = (text) => new Float64Array(bytes(text));
const uint16 = (text) => new Uint16Array(bytes(text));
const uint32 = (text) => new Uint32Array(bytes(text));

/** Numbers of a pose: x, y, z, and a quaternion x, y, z, w. */
export const POSE = 7;

/** The report with its arrays as typed arrays. */
export function readReport(text) {
  const report = JSON.parse(text);
  for (const run of report.runs) {
    run.times = float64(run.times);
    run.poses = float32(run.poses);
    run.vehicle = float32(run.vehicle);
    run.carried = float32(run.carried);
    for (const belt of run.belts) {
      belt.points = float32(belt.points);
      belt.force = float32(belt.force);
    }
    const contacts = run.contacts;
    contacts.start = uint32(contacts.start);
    contacts.sphere = uint16(contacts.sphere);
    contacts.surface = uint16(contacts.surface);
    contacts.point = float32(contacts.point);
    contacts.force = float32(contacts.force);
    for (const plot of run.plots) {
      for (const curve of plot.curves) curve.values = float32(curve.values);
    }
  }
  return report;
}

/** Index of the last output at or before a time, and how far the time is to the next, 0 to 1. */
export function locate(times, time) {
  const last = times.length - 1;
  if (!(time > times[0])) return { index: 0, fraction: 0 };
  if (time >= times[last]) return { index: last, fraction: 0 };
  let low = 0;
  let high = last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return { index: low, fraction: (time - times[low]) / (times[high] - times[low]) };
}

/** Index of the output nearest to a time. */
export function nearest(times, time) {
  const { index, fraction } = locate(times, time);
  return fraction > 0.5 ? index + 1 : index;
}
