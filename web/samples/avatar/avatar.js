// A model of a head that follows a player: pose, position and blendshapes of each picture.
import "../package/src/index.js";
import { AmbientLight, MathUtils, WebGLRenderer } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

const player = document.querySelector("fbs-player");
const canvas = document.querySelector("#model");

// The model from `fbs export talk.fbs head.glb`: an orthographic camera that sees the picture's content, and
// the head below a node whose unit is a pixel.
const { scene, cameras: [camera] } = await new GLTFLoader().loadAsync("../media/head.glb");
const head = scene.getObjectByName("head_0");
const meshes = [];
head.traverse((node) => node.morphTargetDictionary && meshes.push(node));
scene.add(new AmbientLight());

const renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });

function resize() {
  renderer.setPixelRatio(devicePixelRatio);
  const width = canvas.parentElement.clientWidth;
  renderer.setSize(width, (width * camera.top) / camera.right);
}

/** Pitch is applied first, roll last. three.js has y up and z towards the viewer: yaw and roll turn the other way there. */
function pose({ pitch, yaw, roll, x, y, eyeDistance }) {
  const [rx, ry, rz] = [pitch, -yaw, -roll].map(MathUtils.degToRad);
  head.rotation.set(rx, ry, rz, "ZYX");
  head.position.set(x, -y, 0);
  head.scale.setScalar(eyeDistance);
}

function express(blendshapes) {
  for (const mesh of meshes)
    for (const [name, weight] of Object.entries(blendshapes)) {
      const target = mesh.morphTargetDictionary[name];
      if (target !== undefined) mesh.morphTargetInfluences[target] = weight;
    }
}

function follow({ face }) {
  head.visible = face !== null;
  if (face) {
    pose(face.pose);
    express(face.blendshapes);
  }
  renderer.render(scene, camera);
}

player.addEventListener("face", ({ detail }) => follow(detail));
new ResizeObserver(() => {
  resize();
  follow({ face: player.face });
}).observe(canvas.parentElement);
