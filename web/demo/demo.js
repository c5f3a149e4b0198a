// The rows of the demo, from media.json, which make_media.py writes.
import "../package/src/index.js";

const MEDIA = "../media/";

const kbits = (bytes, seconds) => ((bytes * 8) / 1000 / seconds).toFixed(1);

function element(name, attributes, ...children) {
  const out = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) out.setAttribute(key, value);
  out.append(...children);
  return out;
}

function row(entry, seconds) {
  const fbs = kbits(entry.fbs_bytes, seconds), av1 = kbits(entry.av1_bytes, seconds);
  const player = element("fbs-player", { src: MEDIA + entry.fbs, controls: "", loop: "", label: `Talker, fbs at ${fbs} kbit/s` });
  const video = element("video", { src: MEDIA + entry.av1, controls: "", loop: "", "aria-label": `Talker, AV1 at ${av1} kbit/s` });
  // Only one of all is heard.
  for (const one of [player, video])
    one.addEventListener("play", () => {
      for (const other of document.querySelectorAll("fbs-player, video")) if (other !== one) other.pause();
    });
  const peer = `AV1 ${av1} kbit/s, ${entry.av1_size.replace("x", "×")} at ${entry.av1_fps} pictures/s`;
  return element("section", { class: "row" },
    element("h2", {}, `${entry.rate} kbit/s`),
    element("div", { class: "pair" },
      element("figure", {}, element("figcaption", {}, `fbs ${fbs} kbit/s, 352×288 at 25 pictures/s`), player),
      element("figure", {}, element("figcaption", {}, peer), video)));
}

const rows = document.querySelector("#rows");
try {
  const answer = await fetch(`${MEDIA}media.json`, { cache: "no-cache" });
  if (!answer.ok) throw new Error(`media.json: ${answer.status}`);
  const { seconds, media } = await answer.json();
  rows.replaceChildren(...media.map((entry) => row(entry, seconds)));
} catch (fault) {
  rows.replaceChildren(element("p", {}, `The media are not there (${fault.message}): make_media.py makes them.`));
}
