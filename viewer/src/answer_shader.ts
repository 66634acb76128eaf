// SPDX-License-Identifier: MIT
// Draws the answers over the color of a surface, with a crisp border. Colors at vertices would run into each other across
// the triangles of the border; so each pixel is compared with the ball. It belongs to an answer if it lies in the ball and
// in a triangle of which the answer has a corner: the corners of a triangle that lie in the ball are connected.
import * as THREE from 'three';

import { METHOD_COLORS } from './colors';

/** In the coordinates of the scene. */
export interface Ball {
  center: THREE.Vector3;
  /** Negative: the answers are no balls, and their borders lie halfway between vertices. */
  radius: number;
}

const VERTEX = {
  declarations: `
    attribute vec4 answers;
    varying vec3 vAnswers;
    varying vec3 vPlace;`,
  code: `
    vAnswers = answers.xyz;
    vPlace = position;`,
};

const FRAGMENT = {
  declarations: `
    uniform vec3 answerColors[3];
    uniform vec3 ballCenter;
    uniform float ballRadius;
    varying vec3 vAnswers;
    varying vec3 vPlace;
    // 1 where x is positive, 0 where it is negative, and between them within a pixel.
    float sharp(float x) { return clamp(0.5 + x / max(fwidth(x), 1e-30), 0.0, 1.0); }`,
  code: `
    float most = max(vAnswers.x, max(vAnswers.y, vAnswers.z));
    float inBall = sharp(ballRadius - distance(vPlace, ballCenter));
    float inAnswer = ballRadius < 0.0 ? sharp(most - 0.5) : most > 0.0 ? inBall : 0.0;
    vec3 answerColor = vAnswers.x > 0.5 * most ? answerColors[0] : vAnswers.y > 0.5 * most ? answerColors[1] : answerColors[2];
    diffuseColor.rgb = mix(diffuseColor.rgb, answerColor, inAnswer);`,
};

/** Makes a material of three.js draw the answers: the attribute `answers` of its geometry, as `Painting` writes it. */
export function drawAnswers(material: THREE.Material, ball: Ball): void {
  const uniforms = {
    answerColors: { value: [METHOD_COLORS.exact, METHOD_COLORS.paper, METHOD_COLORS.ball].map((color) => new THREE.Color(color)) },
    ballCenter: { value: ball.center },
    ballRadius: { get value() { return ball.radius; } },
  };
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>${VERTEX.declarations}`)
      .replace('#include <begin_vertex>', `#include <begin_vertex>${VERTEX.code}`);
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>${FRAGMENT.declarations}`)
      .replace('#include <color_fragment>', `#include <color_fragment>${FRAGMENT.code}`);
  };
}
