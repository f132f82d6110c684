// Event is plain physics, so that measure/ can read it too.
#pragma once

#include "physics/event.hpp"
