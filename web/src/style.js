/** The player's style. Pages change its colours by the custom properties of :host. */
export const STYLE = `
:host {
  --fbs-background: Canvas;
  --fbs-text: CanvasText;
  --fbs-accent: #0a66c2;
  --fbs-line: color-mix(in srgb, currentColor 22%, transparent);
  display: inline-block;
  width: 352px;
  max-width: 100%;
  color-scheme: light dark;
  font: 14px/1.4 system-ui, sans-serif;
  color: var(--fbs-text);
  background: var(--fbs-background);
}
@media (prefers-color-scheme: dark) {
  :host { --fbs-accent: #7cb8f5; }
}
:host([hidden]) { display: none; }
* { box-sizing: border-box; }
.stage {
  position: relative;
  aspect-ratio: var(--fbs-ratio, 11 / 9);
  background: #16181b;
  overflow: hidden;
}
.stage.turnable { cursor: grab; touch-action: pan-y; }
.stage.turning { cursor: grabbing; }
canvas { display: block; width: 100%; height: 100%; }
.message {
  position: absolute;
  inset: auto 0 0 0;
  margin: 0;
  padding: 6px 10px;
  color: #fff;
  background: rgb(0 0 0 / 72%);
}
.message.alone { inset: 0; display: grid; place-items: center; text-align: center; background: none; }
.message:empty { display: none; }
.bar {
  display: flex;
  flex-wrap: wrap;
  align-items: center;
  gap: 2px 8px;
  padding: 4px 6px;
  border: solid var(--fbs-line);
  border-width: 0 1px 1px;
}
.time { flex: 100 1 96px; min-width: 72px; }
.clock, .rate { font-variant-numeric: tabular-nums; white-space: nowrap; font-size: 13px; }
.right { flex: 1 0 auto; display: flex; align-items: center; justify-content: flex-end; gap: 8px; }
button {
  min-width: 32px;
  height: 32px;
  padding: 0 6px;
  border: 0;
  border-radius: 6px;
  font: inherit;
  color: inherit;
  background: none;
  cursor: pointer;
}
button:hover { background: color-mix(in srgb, currentColor 12%, transparent); }
button svg { display: block; margin: auto; width: 20px; height: 20px; fill: currentColor; }
button.framed { border: 1px solid var(--fbs-line); padding: 0 10px; }
button[aria-expanded="true"] { background: color-mix(in srgb, currentColor 14%, transparent); }
:focus-visible { outline: 2px solid var(--fbs-accent); outline-offset: 1px; }
.stage:focus-visible { outline-offset: -2px; }
input[type="range"] { margin: 0; min-width: 0; height: 24px; accent-color: var(--fbs-accent); cursor: pointer; }
.sound { display: flex; align-items: center; margin-right: auto; }
.sound input { width: 64px; }
.face {
  padding: 8px 10px 10px;
  border: solid var(--fbs-line);
  border-width: 0 1px 1px;
}
.sliders {
  display: grid;
  grid-template-columns: repeat(auto-fit, minmax(150px, 1fr));
  gap: 4px 16px;
}
.sliders label { display: grid; grid-template-columns: 56px 1fr; align-items: center; gap: 8px; }
.deeds { display: flex; flex-wrap: wrap; align-items: center; gap: 8px; margin-top: 8px; }
.hint { margin: 0; font-size: 13px; opacity: 0.8; flex: 1 1 150px; }
[hidden] { display: none !important; }
.spoken { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
`;
