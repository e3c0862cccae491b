// Every function of OpenGL that src/ calls. GlCounts.KnowEveryFunctionThatTheProgramCalls holds it to the
// sources.
#pragma once

// clang-format off
#define CALLED_GL_FUNCTIONS(X) \
  X(glAttachShader) X(glBeginQuery) X(glBindBuffer) X(glBindBufferBase) X(glBindBufferRange) \
  X(glBindFramebuffer) X(glBindTexture) X(glBindTextureUnit) X(glBindVertexArray) X(glBlendFunc) \
  X(glBlitNamedFramebuffer) X(glCheckNamedFramebufferStatus) X(glClearNamedBufferData) \
  X(glClearNamedBufferSubData) X(glClearNamedFramebufferfv) X(glClearNamedFramebufferuiv) \
  X(glClientWaitSync) X(glColorMask) X(glCompileShader) X(glCopyNamedBufferSubData) \
  X(glCreateBuffers) X(glCreateFramebuffers) X(glCreateProgram) X(glCreateQueries) \
  X(glCreateShader) X(glCreateShaderProgramv) X(glCreateTextures) X(glCreateVertexArrays) \
  X(glCullFace) X(glDebugMessageCallback) X(glDeleteBuffers) X(glDeleteFramebuffers) \
  X(glDeleteProgram) X(glDeleteQueries) X(glDeleteShader) X(glDeleteSync) X(glDeleteTextures) \
  X(glDeleteVertexArrays) X(glDepthFunc) X(glDepthMask) X(glDetachShader) X(glDisable) \
  X(glDispatchCompute) X(glDispatchComputeIndirect) X(glDrawArrays) X(glDrawArraysIndirect) \
  X(glDrawArraysInstancedBaseInstance) \
  X(glDrawElements) X(glDrawElementsIndirect) X(glDrawElementsInstanced) X(glDrawElementsInstancedBaseInstance) X(glEnable) \
  X(glEnableVertexArrayAttrib) X(glEndQuery) X(glFenceSync) X(glFinish) X(glFlush) \
  X(glGenerateTextureMipmap) X(glGetAttachedShaders) X(glGetError) X(glGetGraphicsResetStatus) \
  X(glGetInteger64v) X(glGetIntegeri_v) X(glGetIntegerv) X(glGetInternalformativ) \
  X(glGetNamedBufferSubData) X(glGetProgramInfoLog) X(glGetProgramiv) X(glGetQueryObjectui64v) \
  X(glGetShaderInfoLog) X(glGetShaderiv) X(glGetString) X(glLinkProgram) X(glMapNamedBufferRange) \
  X(glMemoryBarrier) X(glNamedBufferStorage) X(glNamedBufferSubData) \
  X(glNamedFramebufferDrawBuffer) X(glNamedFramebufferReadBuffer) X(glNamedFramebufferTexture) \
  X(glObjectLabel) X(glPixelStorei) X(glPolygonMode) X(glPolygonOffset) X(glProgramUniform3f) X(glProgramUniform4i) X(glReadPixels) \
  X(glScissor) X(glShaderSource) X(glTexImage2D) X(glTextureBuffer) X(glTextureBufferRange) X(glTextureParameterfv) X(glTextureParameteri) \
  X(glTextureStorage2D) X(glTextureStorage2DMultisample) X(glTextureSubImage2D) \
  X(glTextureSubImage3D) X(glUseProgram) X(glVertexArrayAttribBinding) \
  X(glVertexArrayAttribFormat) X(glVertexArrayBindingDivisor) X(glVertexArrayElementBuffer) \
  X(glVertexArrayVertexBuffer) X(glVertexAttrib4f) X(glViewport)
// clang-format on
