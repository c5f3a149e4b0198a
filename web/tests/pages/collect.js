// Decodes as the player does, by the worker: all pictures in order, the sound, and what comes out of Web Audio.
import { DecoderClient } from "/package/src/decoder_client.js";
import { SoundOutput } from "/package/src/sound_output.js";

/** @returns {Promise<{ pictures: Uint8Array[], sound: any[], errors: any[] }>} */
export function collect(url) {
  return new Promise((resolve) => {
    const pictures = [], sound = [], errors = [];
    let arrived = null, ended = false;
    const client = new DecoderClient((answer) => {
      if (answer.type === "error") errors.push(answer.error);
      if (answer.type === "error" && answer.error.fatal) resolve({ pictures, sound, errors });
      if (answer.type === "arrival") arrived = answer.arrival;
      if (answer.type === "picture") pictures.push(answer.picture.planes);
      if (answer.type === "picture") client.next(-1);
      if (answer.type === "end") ended = true;
      if (answer.type === "sound") sound.push(answer.sound);
      if (ended && arrived.complete && answer.type !== "arrival") {
        const last = sound[sound.length - 1];
        const time = last ? last.time + last.samples.length / last.channels / last.sampleRate : 0;
        // In pieces, as the player asks for it.
        if (arrived.soundRate && time < arrived.time - 1e-3) client.sound(Math.min(time + 0.7, arrived.time));
        else resolve({ pictures, sound, errors });
      }
    });
    client.load(new URL(url, location.href).href);
    client.next(-1);
  });
}

/** What of the sound is heard when a player starts it at `begin`. */
export async function heard(sound, begin) {
  const { sampleRate } = sound[0];
  const seconds = sound.reduce((sum, { samples, channels }) => sum + samples.length / channels, 0) / sampleRate;
  const context = new OfflineAudioContext(1, Math.ceil((seconds - begin + 0.05) * sampleRate), sampleRate);
  const output = new SoundOutput(sampleRate, context);
  const half = Math.floor(sound.length / 2);
  sound.slice(0, half).forEach((piece) => output.add(piece));
  output.start(begin);
  sound.slice(half).forEach((piece) => output.add(piece));
  return (await context.startRendering()).getChannelData(0);
}

/** @param {string} name @param {BodyInit} content */
export async function report(name, content) {
  await fetch(`/${name}`, { method: "POST", body: content });
}
