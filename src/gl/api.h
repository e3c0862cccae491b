// The one include of OpenGL itself: functions loaded by glad, generated at configure time for 4.5 core.
#pragma once

#include <glad/gl.h>
