"""What published formulas say of a bearing: rating life and its load ratings, friction torque."""
