"""Published formulas for a bearing: rating life, load ratings, friction torque."""
