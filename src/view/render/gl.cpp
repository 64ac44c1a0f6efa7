#include "view/render/gl.h"

#include "base/error.h"

namespace tendril::render {
namespace {

GLuint compiled(GLenum kind, std::string_view defines, std::string_view source) {
  const GLuint shader = glCreateShader(kind);
  const std::string text = "#version 330 core\n" + std::string(defines) + std::string(source);
  const char* start = text.c_str();
  glShaderSource(shader, 1, &start, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (!good) {
    char log[2048] = "";
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    throw UsageError(std::string("a shader does not compile: ") + log);
  }
  return shader;
}

}  // namespace

Context::Context() : page_(16 * 16 * 4) {
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  context_ = OSMesaCreateContextAttribs(attributes, nullptr);
  if (!context_) throw UsageError("OSMesa gives no OpenGL 3.3 context (package libosmesa6)");
  if (!OSMesaMakeCurrent(context_, page_.data(), GL_UNSIGNED_BYTE, 16, 16)) {
    OSMesaDestroyContext(context_);
    throw UsageError("OSMesa's context cannot be made current");
  }
}

Context::~Context() {
  OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
  OSMesaDestroyContext(context_);
}

Program::Program(std::string_view vertex, std::string_view fragment, std::string_view defines)
    : program_(glCreateProgram()) {
  for (const auto& [kind, source] : {std::pair{GL_VERTEX_SHADER, vertex}, std::pair{GL_FRAGMENT_SHADER, fragment}}) {
    const GLuint shader = compiled(kind, defines, source);
    glAttachShader(program_, shader);
    glDeleteShader(shader);
  }
  glLinkProgram(program_);
  GLint good = 0;
  glGetProgramiv(program_, GL_LINK_STATUS, &good);
  if (!good) {
    char log[2048] = "";
    glGetProgramInfoLog(program_, sizeof log, nullptr, log);
    throw UsageError(std::string("a shader does not link: ") + log);
  }
}

void Program::texture(const char* uniform, int unit, GLuint texture) const {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_2D, texture);
  glUniform1i(at(uniform), unit);
}

Texture::Texture(GLenum internal, int width, int height, GLenum format, GLenum type, const void* data, GLenum filter) {
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(internal), width, height, 0, format, type, data);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(filter));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter == GL_NEAREST ? GL_NEAREST : GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

Target::Target(std::vector<GLuint> colours, GLuint depth, int width, int height) : width_(width), height_(height) {
  glGenFramebuffers(1, &name_);
  glBindFramebuffer(GL_FRAMEBUFFER, name_);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    slots_.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
    glFramebufferTexture2D(GL_FRAMEBUFFER, slots_.back(), GL_TEXTURE_2D, colours[i], 0);
  }
  if (depth) glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw UsageError("OSMesa refuses a drawing target of " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels");
}

void Target::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, name_);
  glDrawBuffers(static_cast<GLsizei>(slots_.size()), slots_.data());
  glViewport(0, 0, width_, height_);
}

}  // namespace tendril::render
