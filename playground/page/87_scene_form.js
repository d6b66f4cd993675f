// The scene: what the form says, the changes made since, and the link that holds both.

// family: [words, robots]
const FAMILIES = {
  f7: ["Cluttered field (Fig. 7)", 12], t2: ["Moving discs (Table 2)", 1], t2_hard: ["Many moving discs", 1], p8: ["Eight robots, one square", 8],
  swap: ["Robots change places", 12], clutter: ["Dense clutter", 6], doors: ["Two doors", 6], corridor: ["Corridor", 6], field: ["Large field", 50],
};
const METHODS = {
  space_time: "space-time (ours)", spf_empc: "SPF-EMPC (the paper)", spf_empc_without_field: "SPF-EMPC without field",
  spf_empc_without_self_sampling: "SPF-EMPC without self-sampling", spf_empc_without_observer: "SPF-EMPC without observer", es2: "ES2",
  es2_constant_velocity: "ES2, constant velocity", orca: "ORCA",
};
const MOST_ROBOTS = 60;
const scene = { scenario: {}, trial: 0, changes: [] };
const firstScene = () => ({ scenario: { family: "f7", robots: 12, method: "space_time", noise: { model: "walk", level: 1 } }, trial: 0, changes: [{ do: "crowd", people: 10 }] });

const choices = (entries) => entries.map(([value, words]) => make("option", { value, textContent: words }));
const inputs = ["family", "robots", "people", "method", "noise", "level", "trial"];

function fillForm() {
  byId("family").append(...choices(Object.entries(FAMILIES).map(([name, [words]]) => [name, words])));
  byId("method").append(...choices(Object.entries(METHODS)));
  for (const name of inputs) byId(name).addEventListener("change", () => formChanged(name));
  byId("risk").addEventListener("input", showRisk);
  byId("risk").addEventListener("change", () => changeScene({ do: "risk", seconds: riskNow() }));
}

// The slider is logarithmic: 1 s ... 100000 s; all the way to the left is 0.
const riskNow = () => (Number(byId("risk").value) <= 0 ? 0 : Math.round(10 ** Number(byId("risk").value)));
function showRisk() {
  setText(byId("risk-value"), `${riskNow()} s`);
}

const wholeNumber = (text, low, high) => Math.min(Math.max(Math.round(Number(text)) || 0, low), high);

/** The form's scene: changes that name robots, discs or places belong to the last one. */
function formChanged(name) {
  if (name === "family") byId("robots").value = FAMILIES[byId("family").value][1];
  const people = wholeNumber(byId("people").value, 0, 60);
  const kept = scene.changes.filter((change) => change.do === "risk");
  const stays = ["method", "noise", "level"].includes(name);
  const family = byId("family").value;
  const drawn = family ? { family, robots: wholeNumber(byId("robots").value, 1, MOST_ROBOTS) } : {};  // else written out in the link
  scene.scenario = { ...(stays || !family ? scene.scenario : {}), ...drawn, method: byId("method").value,
    noise: { model: byId("noise").value, level: Number(byId("level").value) } };
  scene.trial = wholeNumber(byId("trial").value, 0, 1e6);
  if (!stays) scene.changes = [...(people > 0 ? [{ do: "crowd", people }] : []), ...kept];
  restart();
}

function showForm() {
  const { family, robots, method, noise } = scene.scenario;
  const known = family in FAMILIES && Number.isInteger(robots);
  byId("family").value = known ? family : "";
  byId("robots").value = Number.isInteger(robots) ? robots : "";
  byId("people").value = scene.changes.find((change) => change.do === "crowd")?.people ?? 0;
  byId("method").value = method ?? "space_time";
  byId("noise").value = noise?.model ?? "walk";
  byId("level").value = String(noise?.level ?? 1);
  byId("trial").value = scene.trial;
  const risk = scene.changes.findLast((change) => change.do === "risk")?.seconds ?? 1000;
  byId("risk").value = risk > 0 ? Math.log10(risk) : 0;
  showRisk();
}

function restart() {
  engine.begun = false;
  showForm();
  writeLink();
  beginScene();
}

/** A change of what runs; a later one of the same thing takes the place of an earlier one in the link. */
function changeScene(change) {
  const fresh = engine.asked === 0;  // nothing has moved yet
  const moves = change.do === "robot" || change.do === "moving";
  if (!moves || fresh) {
    const same = (one) => one.do === change.do && one.robot === change.robot && one.id === change.id;
    if (["goal", "robot", "moving", "risk"].includes(change.do)) scene.changes = scene.changes.filter((one) => !same(one));
    scene.changes.push(change);
    writeLink();
  }
  if (fresh) beginScene(); else engine.worker.postMessage({ change });
}

/** A change that the engine refused is none. */
function takeBack(change) {
  const refused = JSON.stringify(change);
  scene.changes = scene.changes.filter((one) => JSON.stringify(one) !== refused);
  writeLink();
}

// The link: #scene=BASE64URL of the scene's JSON.
const LONGEST_LINK = 100000;
const toLink = (text) => btoa(String.fromCharCode(...new TextEncoder().encode(text))).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
const fromLink = (text) => new TextDecoder().decode(Uint8Array.from(atob(text.replace(/-/g, "+").replace(/_/g, "/")), (c) => c.charCodeAt(0)));
let writtenLink = "";

function writeLink() {
  writtenLink = `#scene=${toLink(JSON.stringify(scene))}`;
  try {
    history.replaceState(null, "", writtenLink);
  } catch {
    // Some browsers refuse for files; the button shows the link.
  }
}

/** The scene of the address; one that cannot be read gives the first scene, and a word about it. */
function readLink() {
  Object.assign(scene, firstScene());
  const text = new URLSearchParams(location.hash.slice(1)).get("scene");
  if (!text) return;
  try {
    if (text.length > LONGEST_LINK) throw new Error("it is too long");
    const read = JSON.parse(fromLink(text));
    if (typeof read.scenario !== "object" || !Array.isArray(read.changes ?? [])) throw new Error("it holds no scene");
    Object.assign(scene, { scenario: read.scenario, trial: read.trial ?? 0, changes: read.changes ?? [] });
  } catch (error) {
    say(`The link cannot be read (${error.message}); this is the first scene.`, true);
  }
}

async function shareLink() {
  const link = location.href.split("#")[0] + writtenLink;
  byId("link").value = link;
  byId("share-dialog").showModal();
  byId("link").select();
  try {
    await navigator.clipboard.writeText(link);
    setText(byId("share-note"), "The link is in the clipboard. It holds the whole scene.");
  } catch {
    setText(byId("share-note"), "Copy this link. It holds the whole scene.");
  }
}
