#include "elements/material.h"
