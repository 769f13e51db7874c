// Draws a GLB from straight above, orthographically and without light: what is left is the texture on the meshes.
import { Color, MeshBasicMaterial, OrthographicCamera, Scene, WebGLRenderer } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

/** RGBA of a photo's size, as bytes in base64; `metres` is the photo's width. What shows no mesh is transparent. */
window.drawTopView = async (address, width, height, metres) => {
  const { scene: field } = await new GLTFLoader().loadAsync(address);
  field.traverse((node) => {
    if (node.isMesh) node.material = new MeshBasicMaterial({ map: node.material.map });
  });
  const scene = new Scene();
  scene.add(field);
  const [right, far] = [metres / 2, ((metres / width) * height) / 2];
  const camera = new OrthographicCamera(-right, right, far, -far, 0, 2 * metres);
  camera.position.y = metres;
  camera.up.set(0, 0, -1);
  camera.lookAt(0, 0, 0);

  const renderer = new WebGLRenderer({ alpha: true, antialias: true, preserveDrawingBuffer: true });
  renderer.setClearColor(new Color(0), 0);
  renderer.setPixelRatio(1);
  renderer.setSize(width, height);
  renderer.render(scene, camera);
  return pixelsOf(renderer.domElement, width, height);
};

window.readPhoto = async (address) => {
  const bitmap = await createImageBitmap(await (await fetch(address)).blob(), { colorSpaceConversion: 'none' });
  return { width: bitmap.width, height: bitmap.height, pixels: pixelsOf(bitmap, bitmap.width, bitmap.height) };
};

function pixelsOf(image, width, height) {
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  const { data } = context.getImageData(0, 0, width, height);
  let text = '';
  for (let at = 0; at < data.length; at += 0x8000) text += String.fromCharCode(...data.subarray(at, at + 0x8000));
  return btoa(text);
}

window.ready = true;
