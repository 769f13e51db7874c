// Owners of OpenGL ES 3.0 objects, and how a GL error becomes a Status.
#pragma once

#include <GLES3/gl3.h>

#include <string>
#include <utility>

#include "tessera/base/status.h"

namespace tessera::gl {

// Owns one object. It must be destroyed while its context, or one that shares with it, is current.
template <void (*create)(GLsizei, GLuint*), void (*destroy)(GLsizei, const GLuint*)>
class Object {
 public:
  Object() { create(1, &id_); }
  ~Object() {
    if (id_ != 0) destroy(1, &id_);
  }
  Object(Object&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  GLuint id() const { return id_; }

 private:
  GLuint id_ = 0;
};

using Buffer = Object<glGenBuffers, glDeleteBuffers>;
using Framebuffer = Object<glGenFramebuffers, glDeleteFramebuffers>;
using Renderbuffer = Object<glGenRenderbuffers, glDeleteRenderbuffers>;
using Texture = Object<glGenTextures, glDeleteTextures>;
using VertexArray = Object<glGenVertexArrays, glDeleteVertexArrays>;

// A linked pair of shaders.
class Program {
 public:
  // Sources begin with "#version 300 es". `name` is what an error message calls the program.
  static Result<Program> build(const char* name, const char* vertex_source, const char* fragment_source);
  ~Program();
  Program(Program&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Program& operator=(Program&&) = delete;

  void use() const { glUseProgram(id_); }
  GLint uniform(const char* name) const { return glGetUniformLocation(id_, name); }

 private:
  explicit Program(GLuint id) : id_(id) {}
  GLuint id_ = 0;
};

// kInternal, with `what` and GL's reason, where GL has recorded an error since the last check.
Result<void> check(const std::string& what);

// kInternal where the framebuffer bound for drawing cannot be drawn to.
Result<void> check_framebuffer(const std::string& what);

}  // namespace tessera::gl
