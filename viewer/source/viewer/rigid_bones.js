/* Shaders in which a vertex follows one bone: three.js blends four, which costs four times the reads of a texture. */

import { ShaderChunk } from "three";

ShaderChunk.skinbase_vertex = `
#ifdef USE_SKINNING
	mat4 boneMatrix = getBoneMatrix( skinIndex.x );
#endif
`;
ShaderChunk.skinnormal_vertex = `
#ifdef USE_SKINNING
	objectNormal = ( boneMatrix * vec4( objectNormal, 0.0 ) ).xyz;
#endif
`;
ShaderChunk.skinning_vertex = `
#ifdef USE_SKINNING
	transformed = ( boneMatrix * vec4( transformed, 1.0 ) ).xyz;
#endif
`;
