#include "tessera/gpu/gl_object.h"

namespace tessera::gl {
namespace {

// Not among the names of OpenGL ES 3.0.
constexpr GLenum kContextLost = 0x0507;       // robust contexts
constexpr GLenum kContextLostWebgl = 0x9242;  // browsers

std::string error_name(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM: return "invalid enum";
    case GL_INVALID_VALUE: return "invalid value";
    case GL_INVALID_OPERATION: return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION: return "invalid framebuffer operation";
    case GL_OUT_OF_MEMORY: return "out of memory";
    case kContextLost:
    case kContextLostWebgl: return "the context was lost";
    default: return "error " + std::to_string(error);
  }
}

tl::unexpected<Status> failure(const std::string& what, const std::string& reason) {
  return fail(StatusCode::kInternal, "", "OpenGL: " + what + ": " + reason);
}

// The first line of what the driver has to say.
template <class Query>
std::string log_of(GLuint id, Query query) {
  char text[512] = "";
  query(id, sizeof text, nullptr, text);
  const std::string log = text;
  return log.empty() ? "no reason given" : log.substr(0, log.find('\n'));
}

Result<GLuint> compile(const std::string& name, GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  const std::string log = log_of(shader, glGetShaderInfoLog);
  glDeleteShader(shader);
  return failure("compiling the shader " + name, log);
}

}  // namespace

Result<Program> Program::build(const char* name, const char* vertex_source, const char* fragment_source) {
  const Result<GLuint> vertex = compile(std::string(name) + ".vert", GL_VERTEX_SHADER, vertex_source);
  if (!vertex) return tl::unexpected(vertex.error());
  const Result<GLuint> fragment = compile(std::string(name) + ".frag", GL_FRAGMENT_SHADER, fragment_source);
  if (!fragment) {
    glDeleteShader(*vertex);
    return tl::unexpected(fragment.error());
  }
  Program program(glCreateProgram());
  for (const GLuint shader : {*vertex, *fragment}) {
    glAttachShader(program.id_, shader);
    glDeleteShader(shader);  // lives on in the program
  }
  glLinkProgram(program.id_);
  GLint linked = GL_FALSE;
  glGetProgramiv(program.id_, GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE)
    return failure(std::string("linking the shaders ") + name, log_of(program.id_, glGetProgramInfoLog));
  return program;
}

Program::~Program() {
  if (id_ != 0) glDeleteProgram(id_);
}

Result<void> check(const std::string& what) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return {};
  return failure(what, error_name(error));
}

Result<void> check_framebuffer(const std::string& what) {
  const GLenum status = glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return {};
  if (Result<void> errors = check(what); !errors) return errors;  // says more
  return failure(what, "the framebuffer is incomplete (status " + std::to_string(status) + ")");
}

}  // namespace tessera::gl
