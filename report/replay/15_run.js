// The run that this page holds.

const run = decodeRun(JSON.parse(document.getElementById("replay-data").textContent));
