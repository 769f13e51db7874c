// Runs the program in a worker; `lines` grows with what it prints.
window.lines = [];
const worker = new Worker('parity_worker.js');
worker.onmessage = ({ data }) => window.lines.push(data);
worker.onerror = (event) => window.lines.push(`error: ${event.message}`);
