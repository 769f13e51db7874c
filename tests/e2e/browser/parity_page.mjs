// Runs the program in a worker; `lines` grows with what it prints, `status` is set when it ends.
window.lines = [];
const worker = new Worker('parity_worker.js');
worker.onmessage = ({ data }) => {
  if ('line' in data) window.lines.push(data.line);
  else window.status = data.status;
};
worker.onerror = (event) => {
  window.lines.push(event.message);
  window.status = -1;
};
